// Runs of the pipeline without the program around it.
#pragma once

#include "run/run/pipeline.h"
#include "support/places.h"

namespace kerf::test {

/// A run of one rank with two workers and otherwise these options.
inline RunReport run_parts(const std::string& input, const std::string& output, std::int32_t parts, Input& read,
                           RunListener* listener = nullptr, RunOptions options = {}) {
    options.input = input;
    options.output = output;
    options.worker_program = test::worker_program();
    options.workers = 2;
    options.decompose.parts = parts;
    SingleRank rank;
    return run(options, 2, rank, read, listener);
}

}  // namespace kerf::test
