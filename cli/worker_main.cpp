// kerf-worker: one mesher call in its own process. Started by kerf; see work/part_job.h for the protocol.
#include <cstdlib>
#include <cstring>

#include "work/part_job.h"

int main(int argc, char** argv) {
    const auto number_behind = [&](const char* option) -> std::int64_t {
        for (int i = 1; i + 1 < argc; i += 2)
            if (std::strcmp(argv[i], option) == 0) return std::strtoll(argv[i + 1], nullptr, 10);
        return 0;
    };
    return kerf::serve_part_job(number_behind("--memory"), number_behind("--parent"));
}
