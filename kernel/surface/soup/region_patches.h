// The patches of a surface that bounds several regions.
#pragma once

#include <string>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// Returns the name of the wall between two regions: A_to_B, where A is the region with the smaller number.
std::string wall_name(const std::vector<std::string>& region_names, FacetSides sides);

/// Gives the walls of a soup with Soup::sides patches of their own; does nothing to a soup without them. Afterwards no
/// patch has both walls and outer facets, and none has the name of a region:
/// - A patch of walls alone whose name is not that of a region stays: the file has drawn it.
/// - Walls of other patches become A_to_B, see wall_name(), for each pair of regions.
/// - Outer facets of a patch with the name of a region become A_outer, where A is the region behind them.
/// New patches are told from others that stay by _2, _3, ... at their ends, and have the colour of the patch of their
/// first facet. All patches are numbered by their first facets; patches without facets are left out. O(#F log n) for n
/// patches.
void name_walls(Soup& soup);

/// Numbers patches by their first facets, keeping their colours, and leaves patches without facets out. O(#F).
void drop_unused_patches(Soup& soup);

}  // namespace kerf
