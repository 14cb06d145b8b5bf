// What this process has taken of the machine's memory.
#pragma once

#include <cstdint>

namespace kerf {

/// The most that was resident at once since the program was started, in bytes; 0 where the system does not tell.
std::int64_t own_peak_rss_bytes();

}  // namespace kerf
