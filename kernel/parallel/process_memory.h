// What this process has taken of the machine's memory, and what it may take.
#pragma once

#include <cstdint>

namespace kerf {

/// The most that was resident at once since the program was started, in bytes; 0 where the system does not tell.
std::int64_t own_peak_rss_bytes();

/// The lesser of the machine's memory and of what this process may have as address space, in bytes.
double most_memory_bytes();

}  // namespace kerf
