// Parts with cells of another order.
#pragma once

#include <functional>
#include <memory>

#include "files/part/edge_numbers.h"
#include "files/part/part.h"

namespace kerf {

/// Returns the parts, which must outlive the result, with cells of this order: 2 with nodes in the middle of edges,
/// which have the numbers that `number` gives (number_edges(), or a function that ranks call together), 1 without nodes
/// on edges and values at them. Null where the parts have this order, and for order 0. Throws the errors of `number`.
std::unique_ptr<PartSource> parts_of_order(const PartSource& parts, int order,
                                           const std::function<EdgeNumbers()>& number);

}  // namespace kerf
