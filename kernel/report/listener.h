// How a run tells of its progress.
#pragma once

#include "prepare/stage_listener.h"
#include "report/report.h"

namespace kerf {

class SecondOrderParts;
class StoredParts;

/// A part has ended, well or not; all numbers are those of the whole run, over all ranks.
struct PartEvent {
    const PartReport* part = nullptr;  ///< with the sums of its result, but without the distributions of its quality
    std::size_t done = 0, total = 0;   ///< parts, this one included
    double load_done = 0;              ///< share of the predicted work, in [0, 1]
    std::int64_t tets = 0;             ///< of the parts that are done
    double tets_expected = 0;          ///< of all parts (RunningForecast), and
    double seconds_left = -1;          ///< until the last one ends; negative: nobody knows yet
};

/// Is told of the progress, on the root rank of that of all ranks. Without one nothing is copied, and the result is the
/// same. Once cancelled() is true, on any rank, the run ends with Error(cancelled) and leaves no result; it is asked
/// between stages, while the surface is remeshed, before cuts and while workers run.
class RunListener : public StageListener {
 public:
    /// The parts before they are meshed, those among them that need not be included, and what is expected of them, as
    /// plan_text() says it: only on the root rank.
    virtual void on_parts(const std::vector<PartReport>&, const std::string& /*plan*/) {}
    /// After every part: only on the root rank.
    virtual void on_part(const PartEvent&) {}
    /// The parts of a transient run when all are meshed: on every rank, in agreement. Their files go when the run ends.
    /// `of_order_2`: the same with nodes on edges, null of order 1.
    virtual void on_meshes(const StoredParts&, const SecondOrderParts* /*of_order_2*/) {}
    /// After every iteration of a solver: its number, the residual beside that of the start, and the one that ends it;
    /// only on the root rank. Must not throw.
    virtual void on_iteration(int /*iteration*/, double /*residual*/, double /*wanted*/) {}
    bool wants_cuts() const override { return false; }
    void on_cut(const Surface&, const Cut&) override {}
};

}  // namespace kerf
