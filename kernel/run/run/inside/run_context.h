// The values that all stages of a run use, and their clocks.
#pragma once

#include <algorithm>

#include "base/core/stopwatch.h"
#include "base/parallel/communicator.h"
#include "run/report/listener.h"
#include "run/run/plan.h"

namespace kerf {

struct RunContext {
    const RunPlan& plan;
    Communicator& ranks;
    RunListener* listener;   ///< may be null
    const Stopwatch& whole;  ///< runs since the run has begun

    bool is_root() const { return ranks.rank() == 0; }

    /// Returns the wall clock of a stage, the longest over the ranks. Collective.
    double longest(const Stopwatch& stopwatch) const {
        double most = 0;
        for (double s : all_gather(ranks, stopwatch.seconds())) most = std::max(most, s);
        return most;
    }

    /// Returns what a stage returns, and adds its wall clock to `seconds`. Collective.
    template <class Stage>
    auto timed(double& seconds, Stage stage) const {
        const Stopwatch stopwatch;
        auto value = stage();
        seconds += longest(stopwatch);
        return value;
    }
};

}  // namespace kerf
