// The common function behind kerf/kerf.h and kerf/mpi.h.
#pragma once

#include <string>

#include "base/parallel/communicator.h"
#include "kerf/kerf.h"

namespace kerf {

/// Does mesh_to_folder() on ranks, each of which has `cores_of_rank` processors for itself. Collective.
void mesh_on_ranks(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                   int cores_of_rank, Communicator& ranks);

}  // namespace kerf
