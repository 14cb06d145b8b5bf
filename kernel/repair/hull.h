// Which facets bound what is inside.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

/// What becomes of a facet.
enum class HullFate : std::uint8_t {
    stays,
    turns,    ///< stays, but its normal points inwards
    copy,     ///< another facet with the same vertices stays
    inside,   ///< inside is on both of its sides
    outside,  ///< on none
};

/// The facets that part inside from outside, which is where facets wind around a point more often than half a time
/// (repair/winding_number.h). Facets may be there several times and in both directions, and may leave holes.
///
/// What lies on their sides is told as find_inside_sides() does (jacobson2013, zhou2016): where facets close the
/// winding numbers are whole, and the result closes, too; where they do not, as few edges as can be are open.
///
/// `facets`: in range and meeting only in the vertices and edges that they share, up to a few that do not; those with a
/// repeated vertex are outside. `poll`: called now and then, may throw. O(#F log #F), 3 s for a million facets.
/// Deterministic.
std::vector<HullFate> find_hull(
    const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const std::function<void()>& poll = [] {});

}  // namespace kerf
