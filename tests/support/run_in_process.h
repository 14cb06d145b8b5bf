// Runs of the pipeline without the program around it.
#pragma once

#include <utility>

#include "run/run/pipeline.h"
#include "support/places.h"

namespace kerf::test {

/// Returns these options with two workers and so many parts.
inline RunOptions with_two_workers(RunOptions options, const std::string& output, std::int32_t parts) {
    options.output = output;
    options.worker_program = test::worker_program();
    options.workers = 2;
    options.decompose.parts = parts;
    return options;
}

/// Runs a file on one rank with two workers and otherwise these options.
inline RunReport run_parts(const std::string& input, const std::string& output, std::int32_t parts,
                           RunOptions options = {}, RunListener* listener = nullptr) {
    options.input = input;
    SingleRank rank;
    return run(with_two_workers(std::move(options), output, parts), 2, rank, listener);
}

/// Runs a surface that no file has in the same way.
inline RunReport run_parts(Input surface, const std::string& output, std::int32_t parts, RunOptions options = {}) {
    SingleRank rank;
    return run(with_two_workers(std::move(options), output, parts), 2, rank, nullptr, std::move(surface));
}

}  // namespace kerf::test
