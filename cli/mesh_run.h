// The run of kerf mesh and kerf decompose on the ranks of a job, and its messages.
#pragma once

#include "cli/mesh_request.h"

namespace kerf {

/// Runs a settled request. Collective. Tells errors, and returns the exit code, the same on every rank.
int mesh_on_ranks(const MeshRequest& request);

}  // namespace kerf
