// kerf mesh and kerf decompose: the run, on the ranks of a job, and what is told of it.
#pragma once

#include "cli/mesh_request.h"

namespace kerf {

/// Runs what a settled request asks for. Collective. Tells errors, and returns the exit code, the same on every rank.
int mesh_on_ranks(const MeshRequest& request);

}  // namespace kerf
