#include "run/peak_memory.h"

#include <array>
#include <cstdio>

namespace kerf {

// VmHWM starts at exec, unlike ru_maxrss, which carries over what the parent had.
std::int64_t own_peak_rss_bytes() {
    std::int64_t kilobytes = 0;
    if (FILE* status = std::fopen("/proc/self/status", "r")) {
        std::array<char, 256> line;
        while (std::fgets(line.data(), line.size(), status))
            if (std::sscanf(line.data(), "VmHWM: %ld", &kilobytes) == 1) break;
        std::fclose(status);
    }
    return kilobytes * 1024;
}

}  // namespace kerf
