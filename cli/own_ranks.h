// A program that starts ranks of itself without being started by mpirun.
#pragma once

#include <optional>

namespace kerf {

/// Whether a launcher such as mpirun has started this process.
bool is_launched();

/// Whether that was run_as_ranks().
bool is_own_launch();

/// Runs `mpirun -n RANKS` of the same program with the same arguments and returns its exit code; that of a cancelled
/// run if SIGINT or SIGTERM comes meanwhile, which the ranks are told as SIGUSR1, since mpirun itself would kill them.
/// Nothing where there is no mpirun on the PATH. Ranks of it are launched (is_launched()).
std::optional<int> run_as_ranks(int ranks, char** argv);

/// Throws Error(io), naming mpirun and the way out, if run_as_ranks() has asked for another number of ranks than there
/// are: an mpirun of another MPI starts as many processes, none of which knows of the others.
void require_own_ranks(int size);

/// Whether standard error ends on a terminal, through mpirun, too, if run_as_ranks() has started it.
bool is_error_on_terminal();

}  // namespace kerf
