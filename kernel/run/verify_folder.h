// A finished run, checked from its files alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/report.h"

namespace kerf {

struct VerifyOptions {
    std::string input;                        ///< where the surface is now; empty: where the run has read it
    bool without_input = false;               ///< the laws of the mesh are enough
    const Input* surface = nullptr;           ///< in place of a file: what make_input() or read_input() has made
    std::function<bool()> is_cancelled = {};  ///< asked between parts, by the caller's thread alone: true ends it with
                                              ///< Error(cancelled)
};

/// What kerf verify found.
struct FolderVerification {
    RunVerification laws;
    std::int64_t tets = 0, vertices = 0;
    std::int64_t nodes = 0;         ///< of order 2: with those on edges; of order 1 as many as vertices
    std::int64_t curved_nodes = 0;  ///< of them, on edges but not in their middle
    std::int32_t parts = 0;
    std::vector<std::string> differences;  ///< what is not as the run has left it, or does not follow from the mesh
    std::string mesh;                      ///< of a solution: the run that it stands on, which all else is about
    std::vector<std::string> solution_differences;  ///< what of it is not as kerf solve has left it
    std::string not_compared;                       ///< why the input was not compared; empty: it was, or was not to be

    /// Value of ErrorCode: `verification` if a law that was asked for does not hold, `io` if all that can be told
    /// without the input hold, but that is gone or another; 0: every law holds.
    int exit_code() const;
};

/// Reads report.json, the input and every file of a run folder, a part a thread at a time (core/threads.h), with the
/// same result for any number of threads, and checks every law again: each part by verify_mesh(), the interfaces by the
/// global numbers, the facets, patches and their names of the input one by one, of order 2 the nodes on edges by
/// EdgeNodeCheck. Every file must have the hash that the report has for it, and the report its own; what follows from
/// the mesh (quality, headers, surfaces, mesh.pvtu, totals, the hash of the mesh) is computed again and compared.
/// Memory follows the surface, not the mesh. Of a solution the files are compared with their hashes, and the run that
/// it stands on is verified. Parts that are missing or cannot be read are differences, too: the others are checked, but
/// not what needs all of them. Throws Error(io) for a folder that is no finished run, Error(verification) for a report
/// that is no such text.
FolderVerification verify_folder(const std::string& folder, const VerifyOptions& options = {});

/// Lines for people: counts, a line for each law that does not hold, the verdict.
std::string to_text(const FolderVerification& found, const std::string& folder, const VerifyOptions& options);

/// An object with every count, the differences, and whether the laws of the mesh hold ("passed").
std::string to_json(const FolderVerification& found, const std::string& folder, const VerifyOptions& options);

}  // namespace kerf
