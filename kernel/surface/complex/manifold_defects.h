// The places where facets fail to be a manifold, and the partners of their corners.
#pragma once

#include <vector>

#include "surface/complex/surface.h"

namespace kerf {

/// Does the work of find_manifold_defects() (surface.h), given partner = edge_partners(facets). O(#V + #F), on threads
/// except for the defects.
std::vector<ManifoldDefect> find_manifold_defects(std::size_t vertex_count, const std::vector<Triangle>& facets,
                                                  std::vector<std::int32_t> partner);

/// The opposite corner of each corner, -1 at a defect, and the defects, those of edges first.
struct CornerPairing {
    std::vector<std::int32_t> partner;
    std::vector<ManifoldDefect> defects;
};

/// Pairs the corners without a partner (-1; `partner` has 3 #F entries) and looks for defects at them.
CornerPairing pair_open_corners(std::size_t vertex_count, const std::vector<Triangle>& facets,
                                std::vector<std::int32_t> partner);

/// Pairs all corners, given partner = edge_partners(facets).
CornerPairing pair_all_corners(std::size_t vertex_count, const std::vector<Triangle>& facets,
                               std::vector<std::int32_t> partner);

}  // namespace kerf
