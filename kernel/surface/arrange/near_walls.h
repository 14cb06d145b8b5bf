// Facets of different bodies that nearly coincide.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Facets that are nearly common walls of two bodies.
struct NearWalls {
    std::vector<char> is_wall;       ///< #F: lies on a facet of another body, nearly or quite; neither is thin
    std::vector<double> apart;       ///< #F: the largest distance from it, units of the surface; 0: they are the same
    std::vector<std::int32_t> thin;  ///< facets that would be walls, but their body is as thin there; ascending
};

/// Finds the facets of each body that share area with one of another body and are within `tolerance` of its plane, and
/// whether they differ from it by more than `nothing`: in height, or because corners and edges are near but not the
/// same. Facets are thin that are within 4 times the tolerance of another facet of their body which shares no vertex
/// with them. Facets without area are never walls. `body`: #F. `check_cancelled` may throw. Expected O(#F log #F).
NearWalls find_near_walls(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                          const std::vector<std::int32_t>& body, double tolerance, double nothing,
                          const std::function<void()>& check_cancelled);

}  // namespace kerf
