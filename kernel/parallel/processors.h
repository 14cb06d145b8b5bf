// The processors that a process may use, and its share of those that several processes of a host use.
#pragma once

#include <sys/types.h>

#include <vector>

namespace kerf {

/// Numbers of the processors that a process may run on, ascending: fewer than the machine has where mpirun, a batch
/// system or taskset has bound it. Those of this process without an argument; empty if the system does not tell.
std::vector<int> allowed_processors(pid_t process = 0);

/// Lets the calling thread, and those that it starts from now on, run on these processors alone, as far as the system
/// allows it; no processors: as it is.
void allow_processors(const std::vector<int>& processors);

/// The number of all processors of the machine; at least 1.
int machine_processors();

/// How many processors one of several processes has for itself if each processor is shared evenly by those that may use
/// it; rounded down, at least 1. `allowed`: per process, as allowed_processors() gives them.
int share_of_processors(const std::vector<std::vector<int>>& allowed, std::size_t process);

}  // namespace kerf
