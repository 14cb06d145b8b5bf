// Sheets without thickness that become walls.
#pragma once

#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// The outcome for the sheets of a soup, by numbers of its facets.
struct Thickening {
    std::vector<std::int32_t> sheet_of;   ///< #F as before; the sheet of each; -1: of none, so that it stays
    std::vector<std::int32_t> sheets;     ///< one facet of each sheet that becomes a wall
    std::vector<std::int32_t> infinite;   ///< one facet of each that stays, because a vertex has no finite coordinates
    std::vector<std::int32_t> unordered;  ///< one at each edge where sheets lie on one another: each wall ends there
    std::vector<std::int32_t> turned_over;  ///< facets of which a side is turned over now: too sharp a bend
    double largest_move = 0;                ///< the largest move of a vertex, units of the surface
};

/// Makes walls of the sheets of a soup, which are the facets that hang together over edges and have an open edge. Both
/// sides of a sheet are moved from it by half of `thickness`: each vertex to where the planes of its facets meet when
/// they are moved (so that edges stay sharp), but not by more than four times that. Facets keep their places, as the
/// front sides; back sides follow, in patches named "NAME_back", and then the facets around the rims, in the patch
/// "rim". Where several sheets meet in an edge, the space between each two neighbours gets a side of its own. A sheet
/// may be one-sided, and its facets turned against each other. The volume of a wall is its area times the thickness, to
/// first order; a fin that ends within a sheet tapers there. Where the sheet is bent more sharply than by a radius of
/// half the thickness, sides cross and are left so. O(#F log #F), deterministic.
Thickening thicken(Soup& soup, double thickness);

}  // namespace kerf
