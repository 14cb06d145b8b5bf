// The surface is cut into the surfaces of the parts, by all ranks.
#pragma once

#include "base/parallel/communicator.h"
#include "cut/decompose/decomposition.h"
#include "run/prepare/input.h"
#include "run/prepare/stage_listener.h"
#include "run/run/plan.h"

namespace kerf {

/// Cuts the surface, and returns the nodes of the tree that belong to this rank and the parts of its range
/// (range_of_rank()). Takes the surface out of `input`, which plan_run() has filled. Writes the trace, if the options
/// ask for one. Collective; throws Error on every rank alike.
Decomposition cut_surface(Communicator& ranks, Input& input, const RunPlan& plan, StageListener* listener);

}  // namespace kerf
