// Facets that closed bodies have in common, and facets inside of the union of these bodies.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Facets that do not bound the union of bodies, each list ascending.
struct CoveredFacets {
    std::vector<std::int32_t> copies;  ///< superfluous ones, of which another in the same place stays
    std::vector<std::int32_t> folds;   ///< facets as often there in one direction as in the other: both sides are alike
    std::vector<std::int32_t> inside;  ///< facets inside of the union, with their copies
    std::vector<char> is_closed;       ///< #F; facets of pieces with copies and as many edges in each direction
    std::vector<char> is_told;         ///< #F; facets of those pieces for which the lists are complete
};

/// Finds the facets that do not bound the union of closed bodies with common facets. It looks at each piece that hangs
/// together over edges, has copies of facets, and has edges as often in one direction as in the other, so that it winds
/// around points in whole numbers. The union of a piece is the space where it winds once or more. Nothing is said of a
/// piece that crosses itself elsewhere than in copies, that winds less than not at all somewhere, because a body in it
/// is inside out, or of which nothing would stay. Requires finite coordinates and facets with three different vertices
/// and area. O(#F), and for these pieces O(n log n). `check_cancelled` may throw.
CoveredFacets find_covered_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                  const std::function<void()>& check_cancelled);

}  // namespace kerf
