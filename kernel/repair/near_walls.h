// Facets of different bodies that nearly coincide.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

struct NearWalls {
    std::vector<char> is_wall;       ///< #F: lies on a facet of another body, nearly or quite; neither is thin
    std::vector<double> apart;       ///< #F: how far from it, at most, units of the surface; 0: not at all
    std::vector<std::int32_t> thin;  ///< facets that would be walls, but their body is as thin there; ascending
};

/// The facets of each body that share area with one of another and are within `tolerance` of its plane, and whether
/// they differ from it by more than `nothing`: in height, or because corners and edges are near but not the same. Those
/// that are within 4 times the tolerance of another facet of their body, which shares no vertex with them, are thin.
/// Facets without area are none of these. `body`: #F. `poll` may throw. Expected O(#F log #F).
NearWalls find_near_walls(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                          const std::vector<std::int32_t>& body, double tolerance, double nothing,
                          const std::function<void()>& poll);

}  // namespace kerf
