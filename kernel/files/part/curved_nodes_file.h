// Nodes that are not in the middle of their edges, as a file of a run.
#pragma once

#include <string>

#include "files/part/edge_nodes.h"

namespace kerf {

/// Returns the path of the file in a run folder that has the curved nodes of the whole mesh, beside its stored parts,
/// which hold none (files/part/part_store.h).
std::string curved_nodes_file(const std::string& folder);

/// Writes the nodes, 32 bytes each. Throws Error(io).
void write_curved_nodes(const std::string& path, const CurvedNodes& nodes);

/// Reads the nodes; their numbers ascend. Throws Error(io) for a file that cannot be read or is damaged.
CurvedNodes read_curved_nodes(const std::string& path);

}  // namespace kerf
