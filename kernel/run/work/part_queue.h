// Parts to worker processes, longest first, a few at a time.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "fill/volume/child_process.h"
#include "run/work/part_job.h"

namespace kerf {

/// A part that waits for a worker.
struct QueuedPart {
    std::string job_file;  ///< path of a file of write_job()
    std::string part_file;
    SizeField size;           ///< wanted in its region, in place of the one in QueueOptions::mesher
    Eigen::AlignedBox3d box;  ///< around its surface: sizes without effect there are not told to its worker
};

/// The outcome of one part over all of its attempts.
struct PartOutcome {
    PartResult result;  ///< result of the last attempt
    std::int32_t attempts = 0;
    std::int32_t worker = 0;            ///< slot in [0, workers)
    double seconds = 0;                 ///< wall clock over all attempts, starting the processes included
    std::vector<std::string> failures;  ///< the reasons why earlier attempts failed
    std::string fallback;      ///< the fallback of the last attempt (fill/volume/retries.h); empty: none was needed
    bool timed_out = false;    ///< an attempt has exceeded the limit of time
    std::string interruption;  ///< the end of a worker whose call was repeated as it was; empty: there was none

    template <class Archive>
    void archive(Archive& a) {
        a(result, attempts, worker, seconds, failures, fallback, timed_out, interruption);
    }
};

/// Options of a queue.
struct QueueOptions {
    std::string worker_program;
    MesherOptions mesher;
    std::int32_t workers = 1;
    double timeout_seconds = 0;  ///< limit of one attempt; 0: none
    std::int64_t memory_mb = 0;
    std::int32_t attempts = 10;
    bool durable = true;  ///< whether the files of parts outlive a power cut
};

/// Meshes parts in processes of their own, up to options.workers at a time.
///
/// Parts that were added wait until a worker is free; parts that are never added are left to queues of other ranks,
/// which may share the list. An attempt that fails for the mesher's reasons (it aborts, crashes, hangs, or returns a
/// mesh that breaks a law) is repeated with the fallbacks of fill/volume/retries.h. The first signal that ends a worker
/// at a part counts as sent from outside, and the same call is made once more: so the part becomes the same as without
/// the signal. A part whose worker is killed twice, or runs out of memory, has failed, and its file is removed.
class PartQueue {
 public:
    PartQueue(std::vector<QueuedPart> parts, QueueOptions options);

    /// Adds a part of the list, which this queue is to mesh.
    void add(std::size_t part) { waiting_.push_back(part); }
    /// Returns the number of workers that no part uses or waits for.
    std::size_t free_workers() const { return idle_.size() > waiting_.size() ? idle_.size() - waiting_.size() : 0; }

    struct Finished {
        std::size_t part;
        PartOutcome outcome;
    };
    /// Starts parts on free workers, and waits until a part is finished, at most `wait_seconds`: returns nothing then.
    /// Sleeps while it waits. Throws Error(io) if a worker cannot be started, std::bad_alloc if there is no memory for
    /// it. The destructor ends all workers.
    std::optional<Finished> step(double wait_seconds);

    /// Whether no part is under way or waits.
    bool empty() const { return waiting_.empty() && pool_.running() == 0; }

 private:
    struct Progress {
        PartOutcome outcome;
        std::size_t call = 0;  // the number of the call under way, of calls_of()
    };
    /// Returns the calls of the mesher for a part, in the order of attempts.
    std::vector<MesherCall> calls_of(std::size_t part) const;
    std::optional<Finished> take_result(std::size_t part, const ChildResult& child);

    std::vector<QueuedPart> parts_;
    QueueOptions options_;
    std::vector<Progress> progress_;
    std::vector<std::int32_t> idle_;  // free workers, the next one last
    std::deque<std::size_t> waiting_;
    ChildPool pool_;
};

}  // namespace kerf
