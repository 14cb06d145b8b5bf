// Fills the rows of a tree from cuts, surfaces, and lists of parts.
#pragma once

#include "run/run/trace.h"
#include "surface/complex/mass_properties.h"
#include "viewer/model/tree.h"

namespace kerf::view {

/// Returns the nodes of a trace with their cuts. Facets, volumes and axes are not known yet: see describe_surface().
Tree tree_of(const Trace& trace);

/// Returns the nodes of a tree with these parts.
Tree tree_of(const std::vector<NodeId>& parts);

/// Fills a row with the facts that a cut, made or not, tells of its node.
void describe_cut(const Cut& cut, TreeRow& row);

/// Fills a row with the facts that the surface of its node tells.
void describe_surface(std::int64_t vertices, std::int64_t facets, const MassProperties& mass, TreeRow& row);

/// Sets the number of parts below each node to that of the parts there are.
void count_leaves(Tree& tree);

}  // namespace kerf::view
