// Nodes that are not in the middle of their edges, as a file of a run.
#pragma once

#include <string>

#include "part/edge_nodes.h"

namespace kerf {

/// Where a run folder has those of the whole mesh, beside its stored parts, which know none (part/part_store.h).
std::string curved_nodes_file(const std::string& folder);

/// 32 bytes a node. Throws Error(io).
void write_curved_nodes(const std::string& path, const CurvedNodes& nodes);

/// Throws Error(io) for a file that cannot be read or is damaged. Numbers ascend when it returns.
CurvedNodes read_curved_nodes(const std::string& path);

}  // namespace kerf
