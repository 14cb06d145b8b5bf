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
};

/// Writes all files of the mesh beside their places and moves them there when they are complete. Refuses places inside
/// of the run's folder. Tells the file and what is in it. Returns the exit code. Throws Error.
int merge_run(const MergeRequest& request);

}  // namespace kerf
