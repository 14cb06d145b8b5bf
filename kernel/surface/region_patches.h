// Patches of a surface that bounds several regions.
#pragma once

#include <string>
#include <vector>

#include "surface/soup.h"

namespace kerf {

/// What the facets between two regions are called: A_to_B, of the regions A and B, that with the smaller number first.
std::string wall_name(const std::vector<std::string>& region_names, FacetSides sides);

/// Gives walls patches of their own, of a soup with Soup::sides; without them nothing happens. No patch has walls and
/// outer facets, and none is called like a region, afterwards:
/// - A patch of nothing but walls that is not called like a region stays: the file has drawn it.
/// - Walls of other patches become A_to_B, see wall_name(), for each pair of regions.
/// - Outer facets of a patch that is called like a region become A_outer, A: the region behind them.
/// New patches are told from others that stay by _2, _3, ... at their ends, and have the colour of the patch of their
/// first facet. All are numbered by their first facets; none without a facet is left. O(#F log n) for n patches.
void name_walls(Soup& soup);

/// Numbers patches by their first facets, with their colours, and leaves those without any out. O(#F).
void drop_unused_patches(Soup& soup);

}  // namespace kerf
