// The places of the programs of Kerf that others start: kerf-worker, kerf-cad, kerf-3mf, kerf-solve, kerf-view, kerf.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// The variable of the environment that names a folder with programs of Kerf.
inline constexpr const char* programs_variable = "KERF_PROGRAMS";

struct ProgramSearch {
    bool found = false;
    std::string path;                    ///< of the program, or the first place that was looked at if it is nowhere
    std::vector<std::string> looked_at;  ///< paths in their order, each once
};

/// Looks for a program by its name, "kerf-worker": in `folder`, unless that is empty; in the folder that the
/// environment names; then, if this function is in a module of a package of Python, where the package has its programs;
/// then beside the library that holds this function and beside the program that runs, there also in bin and
/// libexec/kerf of the installed tree. Costs a few calls of the system.
ProgramSearch look_for_program(const std::string& name, const std::string& folder = "");

/// Returns the path of a program. Throws Error(io), naming the places that were looked at and the way out, if it is
/// nowhere.
std::string find_kerf_program(const std::string& name, const std::string& folder = "");

}  // namespace kerf
