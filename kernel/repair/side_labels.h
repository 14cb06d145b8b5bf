// Which sides of facets are inside.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/types.h"
#include "repair/winding_number.h"

namespace kerf {

/// Whether the space on each side of facets is inside, by front_side() and back_side() (surface/radial_order.h).
///
/// Winding numbers above 1/2 vote for it, by areas, and sides that face each other around an edge should be alike: of
/// all labels those win that are least against votes and leave the fewest edges open, a minimum cut. What hangs
/// together over edges of two facets is labelled as a whole, and only some of its facets vote, if no edge is open; else
/// all do, and are parted where they disagree.
///
/// `facets`: in range, each once, with different corners, each there so many `times` less often turned; `winding` is
/// that of them. `poll` may throw. O(#F log #F) and the questions to `winding`.
std::vector<char> find_inside_sides(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                    const std::vector<std::int32_t>& times, const WindingNumber& winding,
                                    const std::function<void()>& poll);

}  // namespace kerf
