// A plan as bytes, from the first rank to the others, which have not read the surface.
#pragma once

#include "base/core/bytes.h"
#include "run/prepare/input.h"
#include "run/run/plan.h"

namespace kerf {

/// Returns the plan and its input as bytes, as plan_run() leaves them to other ranks. O(#F) for several regions, else a
/// few kilobytes beside sources of sizes, and nodes on edges.
Bytes bytes_of_plan(const RunPlan& plan, const Input& input);

/// Takes over a plan and its input from such bytes. `plan`: with the options as far as a rank resolves them by itself.
/// O(#F log #F) for several regions.
void take_plan(const Bytes& told, RunPlan& plan, Input& input);

}  // namespace kerf
