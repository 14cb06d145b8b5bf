// kerf merge: a finished run as one mesh.
#pragma once

#include <string>

#include "export/format.h"

namespace kerf {

struct MergeRequest {
    std::string folder;  ///< of the run
    std::string output;  ///< file, whose ending chooses the format
    MergeOptions options;
    bool msh_ascii = false;  ///< Gmsh's files as text
    bool quiet = false;      ///< tell nothing
};

/// The format that merges a run into a file with the ending of this one; null if there is none, also for a folder's
/// name with a slash at its end.
const Format* find_merged_format(const std::string& file);

/// Throws Error if the request's file could not be written, or lies in its run, which need not be there yet.
void check_merged_file(const MergeRequest& request);

/// Where the run lies whose mesh `kerf mesh -o FILE` merges into the file: beside it, until the file is there.
std::string run_folder_beside(const std::string& merged_file);
/// The file of such a folder, or of its partial folder; empty for the name of any other.
std::string merged_file_of(const std::string& run_folder);

/// Writes all files of the mesh beside their places and moves them there when they are complete. Refuses places inside
/// of the run's folder. Tells the file and what is in it. Returns the exit code. Throws Error.
int merge_run(const MergeRequest& request);

}  // namespace kerf
