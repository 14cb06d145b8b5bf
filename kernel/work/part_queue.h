// Parts to worker processes, longest first, a few at a time.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "volume/child_process.h"
#include "work/part_job.h"

namespace kerf {

/// A part that waits for a worker.
struct QueuedPart {
    std::string job_file;  ///< of write_job()
    std::string part_file;
    SizeField size;           ///< wanted in its region, in place of that of QueueOptions::mesher
    Eigen::AlignedBox3d box;  ///< around its surface: sizes that have no say there are not told to its worker
};

/// How one part fared over all of its attempts.
struct PartOutcome {
    PartResult result;  ///< of the last attempt
    std::int32_t attempts = 0;
    std::int32_t worker = 0;            ///< slot in [0, workers)
    double seconds = 0;                 ///< wall clock over all attempts, starting the processes included
    std::vector<std::string> failures;  ///< why earlier attempts failed
    std::string fallback;               ///< of the last attempt (volume/retries.h); empty: none was needed
    bool timed_out = false;             ///< an attempt has exceeded the limit of time
    std::string interruption;           ///< how a worker died whose call was repeated as it was; empty: none did

    template <class Archive>
    void archive(Archive& a) {
        a(result, attempts, worker, seconds, failures, fallback, timed_out, interruption);
    }
};

struct QueueOptions {
    std::string worker_program;
    MesherOptions mesher;
    std::int32_t workers = 1;
    double timeout_seconds = 0;  ///< of one attempt; 0: none
    std::int64_t memory_mb = 0;
    std::int32_t attempts = 10;
    bool durable = true;  ///< whether the files of parts outlive a power cut
};

/// Meshes parts in processes of their own, up to options.workers at a time.
///
/// Parts that were added wait until a worker is free; those that are never added are left to queues of other ranks,
/// which may share the list. An attempt that fails for the mesher's reasons
/// (it aborts, crashes, hangs, or returns a mesh that breaks a law) is repeated with the fallbacks of volume/retries.h.
/// The first signal that ends a worker at a part counts as sent from outside, and the same call is made once more: so
/// the part becomes what it would have been. A part whose worker is killed twice, or runs out of memory, has failed,
/// and its file is removed.
class PartQueue {
 public:
    PartQueue(std::vector<QueuedPart> parts, QueueOptions options);

    /// This queue is the one that meshes a part of the list.
    void add(std::size_t part) { waiting_.push_back(part); }
    /// Workers that no part is under way or waits for.
    std::size_t free_workers() const { return idle_.size() > waiting_.size() ? idle_.size() - waiting_.size() : 0; }

    struct Finished {
        std::size_t part;
        PartOutcome outcome;
    };
    /// Starts what can be started, and waits until a part is finished, at most `wait_seconds`: nothing then. Sleeps
    /// while it waits. Throws Error(io) if a worker cannot be started, std::bad_alloc if there is no memory for it. The
    /// destructor ends all workers.
    std::optional<Finished> step(double wait_seconds);

    /// Whether no part is under way or waits.
    bool empty() const { return waiting_.empty() && pool_.running() == 0; }

 private:
    struct Progress {
        PartOutcome outcome;
        std::size_t call = 0;  // of calls_of(), the one under way
    };
    /// As the mesher of the options is called for a part, in the order of attempts.
    std::vector<MesherCall> calls_of(std::size_t part) const;
    std::optional<Finished> take_result(std::size_t part, const ChildResult& child);

    std::vector<QueuedPart> parts_;
    QueueOptions options_;
    std::vector<Progress> progress_;
    std::vector<std::int32_t> idle_;  // workers, the next one last
    std::deque<std::size_t> waiting_;
    ChildPool pool_;
};

}  // namespace kerf
