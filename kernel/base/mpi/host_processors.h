// The processors of a host, as the ranks on it share them.
#pragma once

#include <cstddef>
#include <vector>

#include "base/mpi/mpi_ranks.h"

namespace kerf {

struct HostProcessors {
    std::vector<std::vector<int>> allowed;  ///< of each rank of this host, as allowed_processors() gives them
    std::size_t own = 0;                    ///< index of this rank in `allowed`

    /// Returns the number of processors that this rank has for itself.
    int share() const;
};

/// Asks all ranks of this host. Collective.
HostProcessors host_processors(const MpiRanks& ranks);

}  // namespace kerf
