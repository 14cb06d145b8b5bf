// The processors that a process may use, and its share of those that several processes of a host use.
#pragma once

#include <sys/types.h>

#include <vector>

namespace kerf {

/// Returns the numbers of the processors that a process may run on, ascending: fewer than the machine has where mpirun,
/// a batch system or taskset has bound it. The process is this one without an argument. Empty if the system does not
/// tell.
std::vector<int> allowed_processors(pid_t process = 0);

/// Lets the calling thread, and those that it starts from now on, run on these processors alone, as far as the system
/// allows it; an empty list changes nothing.
void allow_processors(const std::vector<int>& processors);

/// Returns the number of all processors of the machine; at least 1.
int machine_processors();

/// Returns the number of processors that one of several processes has for itself if each processor is shared evenly by
/// those that may use it; rounded down, at least 1. `allowed`: per process, as allowed_processors() gives them.
int share_of_processors(const std::vector<std::vector<int>>& allowed, std::size_t process);

}  // namespace kerf
