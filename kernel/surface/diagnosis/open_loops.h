// The rims of an open surface as loops of edges.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// A chain of edges that have only one facet.
struct OpenLoop {
    std::vector<std::int32_t> vertices;  ///< against the direction of the facets; the last joins the first if closed
    std::vector<std::int32_t> facets;    ///< facets[i] has the edge from vertices[i] to its successor
    bool closed = true;                  ///< false where facets of opposite orientation meet at the rim
    double length = 0;
};

/// Finds all edges of exactly one facet as loops. At a vertex of several rims a loop goes on along the edge of lowest
/// number, and a loop that comes back to such a vertex ends there. Ordered by lowest facet. Requires facets without
/// repeated vertices. O(#F log #F).
std::vector<OpenLoop> find_open_loops(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
