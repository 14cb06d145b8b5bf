// Parts with cells of another order.
#pragma once

#include <functional>
#include <memory>

#include "part/edge_numbers.h"
#include "part/part.h"

namespace kerf {

/// The parts, which must outlive it, with cells of this order: 2 with nodes in the middle of edges, which have the
/// numbers that `number` gives (number_edges() or what does it together), 1 without nodes on edges and values at them.
/// Null where they have this order, and for 0. Throws what `number` throws.
std::unique_ptr<PartSource> parts_of_order(const PartSource& parts, int order,
                                           const std::function<EdgeNumbers()>& number);

}  // namespace kerf
