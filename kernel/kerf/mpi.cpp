#include "kerf/mpi.h"

#include "base/mpi/host_processors.h"
#include "kerf/mesh_on_ranks.h"

namespace kerf {

void mesh_to_folder(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                    MPI_Comm comm) {
    MpiRanks ranks(comm);
    run_together(ranks, [&] { mesh_on_ranks(surface, options, folder, host_processors(ranks).share(), ranks); });
}

}  // namespace kerf
