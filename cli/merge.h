// kerf merge: a finished run as one mesh.
#pragma once

#include "export/merged_file.h"

namespace kerf {

/// Tells the file and what is in it, unless `quiet`. Returns the exit code. Throws Error.
int merge_command(const MergeRequest& request, bool quiet);

}  // namespace kerf
