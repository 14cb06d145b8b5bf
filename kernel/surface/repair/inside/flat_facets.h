// Facets without area, and the divisions of their neighbours by which they go without a gap.
#pragma once

#include <vector>

#include "surface/repair/inside/facet_pieces.h"

namespace kerf {

/// Flat facets, and where their neighbours are to be divided.
struct FlatFacets {
    std::vector<std::int32_t> facets;  ///< facets with three vertices on one line, ascending
    std::vector<SidePoint> points;     ///< on sides of the facets beside them, which are divided there first
};

/// Finds the facets whose corners lie on one line, by exact signs. Flat facets that share edges lie on the same line:
/// once the other facets at these edges are divided at all vertices of the line and the flat ones are gone, each edge
/// has as many facets as before, or an even number more or less. Requires finite coordinates and no facet with a
/// repeated vertex. O(#F log #F).
FlatFacets find_flat_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
