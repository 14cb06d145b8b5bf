// Places where a surface touches itself, at a vertex or along an edge, and their separation.
#pragma once

#include <vector>

#include "surface/repair/repair_report.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The outcome of a separation.
struct FanSeparation {
    std::vector<RepairAction> actions;
    double largest_move = 0;  ///< the largest move of a fan, units of the surface
};

/// Parts a surface where it touches itself. At a vertex each closed fan of facets but the widest gets a vertex of its
/// own. At an edge of more than two facets whose ends are not parted so, each pair of facets
/// (surface/repair/inside/edge_pairs.h) but the widest gets a middle of its own. New vertices move into their fan or
/// pair, by 1e-4 of its shortest edge, or by the resolution of single precision if that is more, at most by `bound`. A
/// fan that would cross other facets then, or lies on others at the vertex, stays as it is, and is reported. Open fans
/// stay together: patches of the openings join them. `at_openings`: only at vertices of edges of one facet. Requires
/// finite coordinates, facets with three different vertices, and orientation. O(#F log #F).
FanSeparation separate_fans(Soup& soup, double bound, bool at_openings = false);

}  // namespace kerf
