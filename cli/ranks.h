// The ranks of an MPI job. The only place that knows MPI.
#pragma once

#include <memory>

#include "run/communicator.h"

namespace kerf {

/// The ranks that mpirun has started, or this process alone. MPI is initialised only where a launcher's environment is
/// found, because that takes 0.3 s. `cores_of_rank`: cores of this host divided by the ranks on it.
struct Ranks {
    std::unique_ptr<Communicator> communicator;
    int cores_of_rank = 1;
};
Ranks join_ranks();

/// Whether this process speaks for the job, told from the launcher's environment without starting MPI.
bool is_first_rank();

}  // namespace kerf
