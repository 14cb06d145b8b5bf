// Places where a surface touches itself, at a vertex or along an edge, and how they come apart.
#pragma once

#include <vector>

#include "repair/repair_report.h"
#include "surface/soup.h"

namespace kerf {

struct FanSeparation {
    std::vector<RepairAction> actions;
    double largest_move = 0;
};

/// Gives each closed fan of facets at a vertex but the widest a vertex of its own, and at an edge of more than two
/// facets both of whose ends have one fan each pair but one a middle of its own (repair/edge_pairs.h). They move into
/// their fan, by 1e-4 of its shortest edge, or what single precision can tell if that is more, at most by `bound`.
/// What would cross other facets then, or lies on others at the vertex, stays as it is, and is said. Open fans stay
/// together: what fills the openings joins them. `at_openings`: only at vertices of edges of one facet. Requires finite
/// coordinates, facets with three different vertices, and orientation. O(#F log #F).
FanSeparation separate_fans(Soup& soup, double bound, bool at_openings = false);

}  // namespace kerf
