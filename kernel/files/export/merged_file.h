// Writes a finished run as one mesh in a file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "files/export/format.h"

namespace kerf {

struct MergeRequest {
    std::string folder;  ///< folder of the run; empty: the parts are of no run
    std::string output;  ///< file, whose ending chooses the format
    MergeOptions options;
    bool msh_ascii = false;                   ///< Gmsh's files as text
    std::function<bool()> is_cancelled = {};  ///< asked before parts are read: true ends it with Error(cancelled)
    int order = 0;                            ///< order of the cells: 1 or 2; 0: that of the run
};

/// The mesh that merge_run() has written.
struct MergedFile {
    std::int64_t vertices = 0, tets = 0;
    std::int64_t bytes = 0;     ///< bytes of all files of the mesh
    std::int64_t nodes = 0;     ///< vertices, and of order 2 the nodes on edges
    std::string left_out = {};  ///< tell_values_left_out()
};

/// Returns the format that merges a run into a file with the ending of this one; null if there is none, also for a
/// folder's name with a slash at its end.
const Format* find_merged_format(const std::string& file);

/// Throws Error if the request's file could not be written, or lies in its run, which need not be there yet.
void check_merged_file(const MergeRequest& request);

/// Returns the folder of a run whose mesh is to be merged into the file when it is done; it lies beside the file.
std::string run_folder_beside(const std::string& merged_file);
/// Returns the file to which a folder of run_folder_beside(), or its partial folder, belongs; empty for all other
/// names.
std::string merged_file_of(const std::string& run_folder);

/// Writes all files of the mesh beside their places and moves them there when they are complete. Refuses places inside
/// of the run's folder. Throws Error.
MergedFile merge_run(const MergeRequest& request);

/// Writes parts that are no run in the same way as merge_run(): the request has no folder.
MergedFile merge_parts(const PartSource& parts, const MergeRequest& request);

}  // namespace kerf
