#include "kerf/mpi.h"

#include <vector>

#include "kerf/mesh_on_ranks.h"
#include "mpi/mpi_ranks.h"
#include "parallel/processors.h"

namespace kerf {

void mesh_to_folder(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                    MPI_Comm comm) {
    MpiRanks ranks(comm);
    run_together(ranks, [&] {
        std::size_t own = 0;
        std::vector<std::vector<int>> allowed;
        for (const Bytes& bytes : ranks.gather_on_host(to_bytes(allowed_processors()), own))
            allowed.push_back(from_bytes<std::vector<int>>(bytes));
        mesh_on_ranks(surface, options, folder, share_of_processors(allowed, own), ranks);
    });
}

}  // namespace kerf
