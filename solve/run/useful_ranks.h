// The useful number of processes for a solution.
#pragma once

#include <cstdint>
#include <string>

namespace kerf {

/// Returns the useful number of ranks for a finished run: no more than it has parts, and so that each has some work; at
/// least 1, also for a run that cannot be read. Reads the report alone.
int useful_ranks_of_run(const std::string& folder);
/// Returns the useful number of ranks for a surface that is to be meshed in `parts` (0: as it follows), told from the
/// size of its file; at least 1.
int useful_ranks_of_surface(const std::string& file, std::int32_t parts);

}  // namespace kerf
