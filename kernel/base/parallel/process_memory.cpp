#include "base/parallel/process_memory.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include <sys/resource.h>
#include <unistd.h>

namespace kerf {

// VmHWM starts at exec, unlike ru_maxrss, which carries over the memory of the parent.
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

double most_memory_bytes() {
    const double pages = sysconf(_SC_PHYS_PAGES);
    const double machine = pages * sysconf(_SC_PAGE_SIZE);
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return machine;
    return std::min<double>(machine, limit.rlim_cur);
}

}  // namespace kerf
