#include "kerf/mpi.h"

#include <vector>

#include "kerf/mesh_on_ranks.h"
#include "mpi/mpi_ranks.h"
#include "parallel/processors.h"

namespace kerf {

void mesh_to_folder(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                    MPI_Comm comm) {
    MpiRanks ranks(comm);
    std::size_t own = 0;
    std::vector<std::vector<int>> allowed;
    for (const Bytes& bytes : ranks.gather_on_host(to_bytes(allowed_processors()), own))
        allowed.push_back(from_bytes<std::vector<int>>(bytes));
    const int cores = share_of_processors(allowed, own);
    run_together(ranks, [&] { mesh_on_ranks(surface, options, folder, cores, ranks); });
}

}  // namespace kerf
