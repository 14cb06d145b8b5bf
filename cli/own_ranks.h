// A program that starts its own ranks where mpirun has not started it.
#pragma once

#include <optional>

namespace kerf {

/// Returns whether a launcher such as mpirun has started this process.
bool is_launched();

/// Returns whether run_as_ranks() has started this process.
bool is_own_launch();

/// Runs `mpirun -n RANKS` of the same program with the same arguments and returns its exit code; nothing where there is
/// no mpirun on the PATH. If SIGINT or SIGTERM comes meanwhile, the code is that of a cancelled run, and the ranks are
/// told by SIGUSR1, since mpirun itself would kill them. In these ranks is_launched() is true.
std::optional<int> run_as_ranks(int ranks, char** argv);

/// Throws Error(io), naming mpirun and the way out, if run_as_ranks() has asked for another number of ranks than there
/// are: an mpirun of another MPI starts as many processes, none of which knows of the others.
void require_own_ranks(int size);

/// Returns whether standard error ends on a terminal, also through an mpirun that run_as_ranks() has started.
bool is_error_on_terminal();

}  // namespace kerf
