// The listener to which a run tells its progress.
#pragma once

#include "run/prepare/stage_listener.h"
#include "run/report/report.h"

namespace kerf {

class SecondOrderParts;
class StoredParts;

/// The event that a part has ended, well or not; all numbers are those of the whole run, over all ranks.
struct PartEvent {
    /// The part, with the sums of its result, but without the distributions of its quality.
    const PartReport* part = nullptr;
    std::size_t done = 0, total = 0;  ///< numbers of parts that have ended, this one included, and of all
    double load_done = 0;             ///< share of the predicted work that is done, in [0, 1]
    std::int64_t tets = 0;            ///< cells of the parts that are done
    double tets_expected = 0;         ///< forecast for all parts (RunningForecast)
    double seconds_left = -1;         ///< forecast until the last part ends; negative: not known yet
};

/// Is told of the progress; on the root rank, of the progress of all ranks. Without a listener nothing is copied, and
/// the result is the same. Once cancelled() is true, on any rank, the run ends with Error(cancelled) and leaves no
/// result; it is asked between stages, while the surface is remeshed, before cuts and while workers run.
class RunListener : public StageListener {
 public:
    /// Is told of the parts before they are meshed, with those among them that need not be, and of the forecast for
    /// them as plan_text() words it: only on the root rank.
    virtual void on_parts(const std::vector<PartReport>&, const std::string& /*plan*/) {}
    /// Is told after every part: only on the root rank.
    virtual void on_part(const PartEvent&) {}
    /// Gets the parts of a transient run when all are meshed: on every rank, in agreement. Their files go when the run
    /// ends. `of_order_2`: the same parts with nodes on edges; null for order 1.
    virtual void on_meshes(const StoredParts&, const SecondOrderParts* /*of_order_2*/) {}
    /// Is told after every iteration of a solver: its number, the residual over that of the start, and the ratio that
    /// ends it; only on the root rank. Must not throw.
    virtual void on_iteration(int /*iteration*/, double /*residual*/, double /*wanted*/) {}
    bool wants_cuts() const override { return false; }
    void on_cut(const Surface&, const Cut&) override {}
};

}  // namespace kerf
