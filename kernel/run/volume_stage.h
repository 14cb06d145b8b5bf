// The parts of a run are meshed by the workers of all ranks.
#pragma once

#include "io/run_folder.h"
#include "parallel/communicator.h"
#include "report/listener.h"
#include "work/part_queue.h"

namespace kerf {

/// Every rank hands over the parts that it has cut; then the workers of all ranks take them, longest first, from one
/// list. A part goes by files, from the rank that cut it to the worker that takes it, and from the worker to its place:
/// no rank holds more than numbers. The root rank hands the parts out, one to each worker that is free; ranks post what
/// they have finished to it, and it tells all when nothing is left.
class VolumeStage {
 public:
    /// `length_scale`: of the distributions of the quality.
    /// `worker_hash`: of the program that does the work, see hash_of_job().
    VolumeStage(Communicator& ranks, RunFolder& folder, const RunOptions& options, std::string worker_hash,
                double length_scale, RunListener* listener)
        : ranks_(ranks),
          folder_(folder),
          options_(options),
          worker_hash_(std::move(worker_hash)),
          listener_(listener),
          quality_(length_scale) {}

    /// The job of `part` waits in the folder when this returns, unless an interrupted run has finished it: then
    /// `part` gets its outcome. Throws Error(io).
    void hand_over(const PartJob& job, PartReport& part);

    /// Collective. `parts`: all parts of the run, the same on every rank, after they were handed over. On return they
    /// have their outcomes on every rank, but for the distributions of their quality, which are added to `quality`
    /// and `improvement`.
    /// Throws Error on every rank alike: `cancelled` if any was cancelled, `io` if a part could not be written, with
    /// all workers ended.
    void mesh(std::vector<PartReport>& parts, PartQuality& quality, Improvement& improvement);

 private:
    struct Message;
    class Tally;
    class HandOut;
    std::vector<std::size_t> waiting_parts(const std::vector<PartReport>& parts) const;
    PartQueue queue_of(const std::vector<PartReport>& parts, const std::vector<std::size_t>& order) const;
    std::vector<PartReport> mesh_share(const std::vector<PartReport>& parts, bool& was_told_to_stop);
    void add_quality(const PartResult& result);
    void keep_outcome(const PartReport& part) const;
    void post_to_others(const Message& message);

    Communicator& ranks_;
    RunFolder& folder_;
    const RunOptions& options_;
    std::string worker_hash_;
    RunListener* listener_;
    // Of the parts that this rank has meshed, or found finished.
    PartQuality quality_;
    Improvement improvement_;
};

}  // namespace kerf
