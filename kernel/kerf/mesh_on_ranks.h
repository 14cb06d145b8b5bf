// What kerf/kerf.h and kerf/mpi.h have in common.
#pragma once

#include <string>

#include "kerf/kerf.h"
#include "parallel/communicator.h"

namespace kerf {

/// mesh_to_folder() on ranks, each of which has so many processors for itself. Collective.
void mesh_on_ranks(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                   int cores_of_rank, Communicator& ranks);

}  // namespace kerf
