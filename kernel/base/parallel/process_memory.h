// The memory that this process has taken of the machine's, and the most that it may take.
#pragma once

#include <cstdint>

namespace kerf {

/// Returns the most memory that was resident at once since the program was started, in bytes; 0 where the system does
/// not tell.
std::int64_t own_peak_rss_bytes();

/// Returns the lesser of the machine's memory and of the address space that this process may have, in bytes.
double most_memory_bytes();

}  // namespace kerf
