// Where facets fail to be a manifold, and which of their corners are partners.
#pragma once

#include <vector>

#include "surface/surface.h"

namespace kerf {

/// find_manifold_defects() (surface.h) where `partner`, which is edge_partners(facets), is known. O(#V + #F), on
/// threads but for defects.
std::vector<ManifoldDefect> find_manifold_defects(std::size_t vertex_count, const std::vector<Triangle>& facets,
                                                  std::vector<std::int32_t> partner);

/// The opposite corner of each, -1 at a defect; and these, first those of edges.
struct CornerPairing {
    std::vector<std::int32_t> partner;
    std::vector<ManifoldDefect> defects;
};

/// Pairs the corners, 3 #F, that have no partner yet, which is -1, and looks for defects at them.
CornerPairing pair_open_corners(std::size_t vertex_count, const std::vector<Triangle>& facets,
                                std::vector<std::int32_t> partner);

/// Pairs all corners. `partner`: edge_partners(facets).
CornerPairing pair_all_corners(std::size_t vertex_count, const std::vector<Triangle>& facets,
                               std::vector<std::int32_t> partner);

}  // namespace kerf
