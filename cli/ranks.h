// The ranks of a program as a launcher has started them.
#pragma once

#include <memory>
#include <string>

#include "base/parallel/communicator.h"

namespace kerf {

class MpiRanks;

/// The ranks that mpirun has started, or this process alone. MPI is initialised only where a launcher's environment is
/// found, because that takes 0.3 s.
struct Ranks {
    std::unique_ptr<Communicator> communicator;
    MpiRanks* mpi = nullptr;  ///< the same ranks, for code that calls MPI itself; null for a process without MPI
    int cores_of_rank = 1;    ///< processors that the rank may use, divided by the ranks of this host that share them
    int bound_to = 1;         ///< processors that the rank with the fewest of all ranks may use
    int unbound_share = 1;    ///< cores_of_rank as it would be if the launcher had bound no rank
    bool launched = false;
};
enum class MpiUse {
    if_launched,  ///< a process alone does without MPI, which takes 0.3 s to initialise
    always,       ///< for a program that calls MPI itself
};
/// Returns the ranks. Collective. Throws Error(internal) if the MPI library does not allow the threads that a rank has
/// beside its first.
Ranks join_ranks(MpiUse use = MpiUse::if_launched);

/// Returns a line for the user, with a remedy, if the ranks are bound to fewer processors than there are for the
/// workers; empty if all is well, or nothing would lift it. `workers` of each rank; 0: the default.
std::string binding_note(const Ranks& ranks, int workers);

/// Returns whether this process speaks for the job, told from the launcher's environment without starting MPI.
bool is_first_rank();

}  // namespace kerf
