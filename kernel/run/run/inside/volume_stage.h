// The parts of a run are meshed by the workers of all ranks.
#pragma once

#include "base/parallel/communicator.h"
#include "files/io/run_folder.h"
#include "run/report/listener.h"
#include "run/run/inside/part_hand_out.h"
#include "run/run/plan.h"
#include "run/work/part_queue.h"

namespace kerf {

/// The outcome of all parts of a run.
struct MeshedParts {
    std::vector<PartReport> parts;  ///< reports of the parts, without the distributions of their quality: the sums of
                                    ///< these are in `quality`
    PartQuality quality;
    Improvement improvement;
};

/// Meshes the parts. Every rank hands over the parts that it has cut; then the workers of all ranks take them, longest
/// first, from one list, rather those of their own host where these are nearly as long. A part goes by files, from the
/// rank that cut it to the worker that takes it, and from the worker to its place: no rank holds more than numbers. The
/// root rank hands the parts out, one to each worker that is free; ranks post the parts that they have finished to it,
/// and it tells all when nothing is left. Ranks that wait sleep.
class VolumeStage {
 public:
    /// Takes the plan of the run. `length_scale`: the scale of the distributions of quality. All references must
    /// outlive the stage.
    VolumeStage(Communicator& ranks, RunFolder& folder, const RunPlan& plan, double length_scale, RunListener* listener)
        : ranks_(ranks), folder_(folder), plan_(plan), listener_(listener), own_{{}, PartQuality(length_scale), {}} {}

    /// Writes the job of `part` into the folder, unless an interrupted run has finished the part: then `part` gets its
    /// outcome. Throws Error(io).
    void hand_over(const PartJob& job, PartReport& part);

    /// Meshes all parts that were handed over and returns their outcome, the same on every rank. Collective. `parts`:
    /// all parts of the run, the same on every rank. Throws Error on every rank alike: `cancelled` if any was
    /// cancelled, `io` if a part could not be written, with all workers ended.
    MeshedParts mesh(const std::vector<PartReport>& parts);

 private:
    class Tally;
    std::vector<std::size_t> waiting_parts(const std::vector<PartReport>& parts) const;
    PartQueue queue_of(const std::vector<PartReport>& parts, const std::vector<std::size_t>& order) const;
    PartHandOut hand_out_to(PartQueue& queue, const std::vector<PartReport>& parts,
                            const std::vector<std::size_t>& order, const std::vector<std::int32_t>& host_of_rank) const;
    bool take_messages(PartHandOut& hand_out, Tally* tally, bool& was_told_to_stop);
    void keep_finished(PartReport part, Tally* tally);
    void add_quality(const PartResult& result);
    void keep_outcome(const PartReport& part) const;
    void post_to_others(const VolumeMessage& message);
    MeshedParts gather(std::vector<PartReport> parts);

    Communicator& ranks_;
    RunFolder& folder_;
    const RunPlan& plan_;
    RunListener* listener_;
    MeshedParts own_;  // the parts that this rank has meshed; the sums count the parts that it has found finished, too
};

}  // namespace kerf
