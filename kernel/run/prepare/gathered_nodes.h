// The tree of a decomposition, brought together over all ranks.
#pragma once

#include <string>
#include <vector>

#include "base/parallel/communicator.h"
#include "cut/decompose/tree_node.h"

namespace kerf {

/// Returns the nodes of all ranks, each once, ascending by number. `host`: of this rank, for the message. One rank
/// compares the nodes; the others get each node once. Collective.
///
/// A cut along edges is made by one rank alone. Straight cuts, and nodes of several regions, are made by each rank for
/// itself, and parts of unlike ones would not fit. So their hashes are compared: if two ranks have the same node with
/// different hashes, as unlike mathematical libraries could make them, Error(internal) is thrown on every rank alike;
/// it names the node, the ranks and their hosts.
std::vector<TreeNode> gather_nodes(Communicator& ranks, const std::vector<TreeNode>& own, const std::string& host);

}  // namespace kerf
