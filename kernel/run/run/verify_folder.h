// A finished run, checked from its files alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/report/report.h"

namespace kerf {

struct VerifyOptions {
    std::string input;                        ///< path of the surface now; empty: the path that the run has read
    bool without_input = false;               ///< true: the input is not compared, the laws of the mesh are enough
    const Input* surface = nullptr;           ///< input of make_input() or read_input(), in place of a file
    std::function<bool()> is_cancelled = {};  ///< asked between parts, by the caller's thread alone: true ends it with
                                              ///< Error(cancelled)
};

/// The findings of kerf verify.
struct FolderVerification {
    RunVerification laws;
    std::int64_t tets = 0, vertices = 0;
    std::int64_t nodes = 0;  ///< number of nodes: of order 2 with those on edges, of order 1 that of the vertices
    std::int64_t curved_nodes = 0;  ///< number of the nodes that are on edges but not in their middle
    std::int32_t parts = 0;
    /// Sentences on all that is not as the run has left it, or does not follow from the mesh.
    std::vector<std::string> differences;
    std::string mesh;  ///< path of the run that a solution stands on, which all else is about; empty for a run
    /// Sentences on files of the solution that are not as kerf solve has left them.
    std::vector<std::string> solution_differences;
    std::string not_compared;  ///< reason why the input was not compared; empty: it was, or was not to be

    /// Returns a value of ErrorCode: `verification` if a law that was asked for does not hold, `io` if all laws that
    /// can be checked without the input hold, but the input is gone or another; 0 if every law holds.
    int exit_code() const;
};

/// Reads report.json, the input and every file of a run folder, a part a thread at a time (base/core/threads.h), with
/// the same result for any number of threads, and checks every law again: each part by verify_mesh(), the interfaces by
/// the global numbers, the facets, patches and their names of the input one by one, of order 2 the nodes on edges by
/// EdgeNodeCheck. Every file must have the hash that the report has for it, and the report its own; quality, headers,
/// surfaces, mesh.pvtu, totals and the hash of the mesh, which follow from the mesh, are computed again and compared.
/// Memory follows the surface, not the mesh. Of a solution the files are compared with their hashes, and the run that
/// it stands on is verified. Parts that are missing or cannot be read are differences, too: the others are checked, but
/// not the laws that need all of them. Throws Error(io) for a folder that is no finished run, Error(verification) for a
/// report that is no such text.
FolderVerification verify_folder(const std::string& folder, const VerifyOptions& options = {});

/// Returns lines for people: counts, a line for each law that does not hold, the verdict.
std::string to_text(const FolderVerification& found, const std::string& folder, const VerifyOptions& options);

/// Returns a JSON object with every count, the differences, and whether the laws of the mesh hold ("passed").
std::string to_json(const FolderVerification& found, const std::string& folder, const VerifyOptions& options);

}  // namespace kerf
