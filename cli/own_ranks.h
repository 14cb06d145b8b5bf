// A program that becomes ranks of itself without being started by mpirun.
#pragma once

namespace kerf {

/// Whether a launcher such as mpirun has started this process.
bool is_launched();

/// Replaces this process by `mpirun -n RANKS` of the same program with the same arguments. Returns where that is not
/// possible: there is no mpirun on the PATH. Ranks of it are launched (is_launched()).
void become_ranks(int ranks, char** argv);

/// Whether standard error ends on a terminal, through mpirun, too, if become_ranks() has started it.
bool is_error_on_terminal();

}  // namespace kerf
