// Facets without area, that go without a gap.
#pragma once

#include <vector>

#include "repair/facet_pieces.h"

namespace kerf {

struct FlatFacets {
    std::vector<std::int32_t> facets;  ///< with three vertices on one line, ascending
    std::vector<SidePoint> points;     ///< where the facets beside them are to be divided before they go
};

/// Facets whose corners lie on one line, by exact signs. Those that share edges lie on the same line: once all facets
/// that have one of these edges are divided at all of their vertices, each edge has as many facets more or less, by
/// even numbers, as before. Requires finite coordinates and no facet with a repeated vertex. O(#F log #F).
FlatFacets find_flat_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
