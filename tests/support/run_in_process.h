// Runs of the pipeline without the program around it.
#pragma once

#include <utility>

#include "run/run/pipeline.h"
#include "support/places.h"

namespace kerf::test {

/// Returns these options with two workers and so many parts.
inline RunRequest with_two_workers(RunRequest options, const std::string& output, std::int32_t parts) {
    options.output = output;
    options.workers.program = test::worker_program();
    options.workers.count = 2;
    options.parts = parts;
    return options;
}

/// Runs a file on one rank with two workers and otherwise these options.
inline RunReport run_parts(const std::string& input, const std::string& output, std::int32_t parts,
                           RunRequest options = {}, RunListener* listener = nullptr) {
    options.input = input;
    SingleRank rank;
    return run(with_two_workers(std::move(options), output, parts), 2, rank, listener);
}

/// Runs a surface that no file has in the same way.
inline RunReport run_parts(Input surface, const std::string& output, std::int32_t parts, RunRequest options = {}) {
    SingleRank rank;
    return run(with_two_workers(std::move(options), output, parts), 2, rank, nullptr, std::move(surface));
}

}  // namespace kerf::test
