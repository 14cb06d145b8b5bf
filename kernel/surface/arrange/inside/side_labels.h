// Labels of the sides of facets, inside or outside.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/core/types.h"
#include "surface/arrange/winding_number.h"

namespace kerf {

/// Returns whether the space on each side of each facet is inside (2 #F), by front_side() and back_side()
/// (surface/soup/radial_order.h).
///
/// Winding numbers above 1/2 vote for inside, weighted by areas, and sides that face each other around an edge should
/// be alike: a minimum cut finds the labels that are least against votes and leave the fewest edges open. If no edge is
/// open, facets that hang together over edges of two are labelled as a whole, and only some of them vote; else all
/// vote, and are parted where they disagree.
///
/// `facets`: in range, each once, with different corners, each standing for `times` facets, those that are turned
/// subtracted; `winding` is that of them. `check_cancelled` may throw. O(#F log #F) and the questions to `winding`.
std::vector<char> find_inside_sides(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                    const std::vector<std::int32_t>& times, const WindingNumber& winding,
                                    const std::function<void()>& check_cancelled);

}  // namespace kerf
