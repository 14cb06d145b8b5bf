// Where the sources, the programs and the outputs of this build are.
//
// Their values stand in one generated source (places.cpp.in), not in macros: the objects of all tests are the same in
// every folder that way, and a cache of compilations serves a clone, too.
#pragma once

#include <string>

namespace kerf::test {

/// The root of the repository.
std::string source_folder();

/// The folder of surfaces that every checkout holds.
std::string asset_folder();

/// The root of this build.
std::string build_folder();

/// Where golden pictures and words that are not as they should be are kept, for ./run goldens.
std::string candidate_folder();

/// Real surfaces that are not part of the repository (KERF_CORPUS); empty: none.
std::string corpus_folder();

/// Programs that tests start: those of this build, or of KERF_TEST_PROGRAMS.
std::string kerf_program();
std::string worker_program();
std::string cad_program();
std::string threemf_program();

}  // namespace kerf::test
