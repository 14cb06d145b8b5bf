// Facets that closed bodies have in common, and those that lie inside of their union.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

struct CoveredFacets {
    std::vector<std::int32_t> copies;  ///< of facets of which one stays
    std::vector<std::int32_t>
        folds;  ///< there as often in one direction as in the other: what is on their sides is alike
    std::vector<std::int32_t> inside;  ///< of the union, with their copies
    std::vector<char> is_closed;       ///< #F; of a piece with copies whose edges are there as often in each direction
    std::vector<char> is_told;         ///< #F; and of which the lists say all
};

/// Of what hangs together over edges, has copies of facets, and winds around points in whole numbers because its edges
/// are there as often in one direction as in the other: what does not bound its union, which is where it winds once or
/// more. Nothing is said of a piece that crosses itself elsewhere than in copies, that winds less than not at all
/// somewhere, because a body in it is inside out, or of which nothing would stay. Facets ascending; requires finite
/// coordinates and facets with three different vertices and area. O(#F), and for these pieces O(n log n). `poll` may
/// throw.
CoveredFacets find_covered_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                  const std::function<void()>& poll);

}  // namespace kerf
