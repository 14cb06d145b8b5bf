// Facets that bound the inside of a surface, as its winding numbers tell.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The fate of a facet in a hull.
enum class HullFate : std::uint8_t {
    stays,
    turns,    ///< stays, but is turned over: its normal points inwards
    copy,     ///< goes: another facet with the same vertices stays
    inside,   ///< goes: inside is on both of its sides
    outside,  ///< goes: outside is on both
};

/// Finds the facets that part inside from outside, and returns the fate of each facet (#F). Inside is where facets wind
/// around a point more often than half a time (surface/arrange/winding_number.h). Facets may be there several times and
/// in both directions, and may leave holes.
///
/// Winding numbers above 1/2 vote for the inside of a side, weighted by areas, and sides that face each other around an
/// edge should be alike: a minimum cut finds the labels that are least against votes and leave the fewest edges open
/// (jacobson2013, zhou2016). Where facets close, winding numbers are whole, and the result closes, too.
///
/// `facets`: in range and meeting only in the vertices and edges that they share, up to a few that do not; facets with
/// a repeated vertex are outside. `check_cancelled`: called now and then, may throw. O(#F log #F), 3 s for a million
/// facets. Deterministic.
std::vector<HullFate> find_hull(
    const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
    const std::function<void()>& check_cancelled = [] {});

}  // namespace kerf
