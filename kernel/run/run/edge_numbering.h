// The nodes of second order, numbered by all ranks.
#pragma once

#include "base/parallel/communicator.h"
#include "files/part/edge_numbers.h"
#include "files/part/second_order_parts.h"
#include "run/report/listener.h"

namespace kerf {

/// Numbers the nodes on edges as number_edges() does in one process, while every rank loads its share of the parts.
/// Collective; the same on all ranks. Throws Error on every rank alike.
EdgeNumbers number_edges_together(Communicator& ranks, const PartSource& parts, RunListener* listener);

}  // namespace kerf
