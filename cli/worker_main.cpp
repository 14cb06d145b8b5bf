// kerf-worker: one mesher call in its own process. Started by kerf; see run/part_job.h for the protocol.
#include <cstdlib>
#include <cstring>

#include "run/part_job.h"

int main(int argc, char** argv) {
    std::int64_t memory_mb = 0;
    if (argc == 3 && std::strcmp(argv[1], "--memory") == 0) memory_mb = std::strtoll(argv[2], nullptr, 10);
    return kerf::serve_part_job(memory_mb);
}
