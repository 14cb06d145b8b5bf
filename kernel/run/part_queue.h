// Parts to worker processes, longest first, a few at a time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/part_job.h"

namespace kerf {

/// How one part fared over all of its attempts.
struct PartOutcome {
    PartResult result;  ///< of the last attempt
    std::int32_t attempts = 0;
    std::int32_t worker = 0;            ///< slot in [0, workers)
    double seconds = 0;                 ///< wall clock over all attempts, starting the processes included
    std::vector<std::string> failures;  ///< why earlier attempts failed
    std::string remedy;                 ///< of the last attempt (volume/retries.h); empty: none was needed
};

struct QueueOptions {
    std::string worker_program;
    std::int32_t workers = 1;
    double timeout_seconds = 0;  ///< of one attempt; 0: none
    std::int64_t memory_mb = 0;
    std::int32_t attempts = 8;
    std::function<bool()> cancelled = [] { return false; };  ///< asked a few times a second
};

/// Runs every job in a process of its own, `workers` at a time, in the given order; outcomes come back in the same
/// order. An attempt that fails for the mesher's reasons (it aborts, crashes, hangs, or returns a mesh that breaks a
/// law) is repeated with the remedies of volume/retries.h. A worker that was killed from outside or ran out of memory
/// is not: the part has failed. `finished` is called after every part. Throws Error(cancelled), with all workers ended,
/// once `cancelled` says so.
std::vector<PartOutcome> run_part_jobs(std::vector<PartJob> jobs, const QueueOptions& options,
                                       const std::function<void(std::size_t index, const PartOutcome&)>& finished);

}  // namespace kerf
