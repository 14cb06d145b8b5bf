// The nodes of second order, numbered by all ranks.
#pragma once

#include "parallel/communicator.h"
#include "part/edge_numbers.h"
#include "part/second_order_parts.h"
#include "report/listener.h"

namespace kerf {

/// As number_edges() of one process: every rank loads its share of the parts. Collective; the same on all ranks. Throws
/// Error on every rank alike.
EdgeNumbers number_edges_together(Communicator& ranks, const PartSource& parts, RunListener* listener);

/// Tells the report how many nodes the mesh has, and each part that was meshed.
void count_nodes(const SecondOrderParts& parts, RunReport& report);

}  // namespace kerf
