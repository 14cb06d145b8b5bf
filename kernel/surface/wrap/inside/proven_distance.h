// A bound of the distance of triangles from a surface: proven, not sampled.
#pragma once

#include <functional>
#include <vector>

#include "base/core/types.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

/// Returns a bound of the distance of every point of the chosen facets from the nearest point of another set: no point
/// is farther away, and some point is as far but for a few percent, where `tolerance` is less than that; 0 for no
/// facets. Nearness divides facets until each piece is near a single other facet as a whole. `chosen`: #F, empty for
/// all. `tree`: of `others`, none of them degenerate. `tolerance`: a length that counts as none, > 0. `check_cancelled`
/// may throw. O(#F log #F).
double proven_distance(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                       const std::vector<char>& chosen, const TriangleTree& tree, const std::vector<Triangle>& others,
                       double tolerance, const std::function<void()>& check_cancelled);

}  // namespace kerf
