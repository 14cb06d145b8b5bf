// Which facets of a soup are neighbours.
#pragma once

#include <vector>

#include "core/types.h"

namespace kerf {

/// Corner 3 f + i is the edge of facet f from its vertex i to the next. For every corner that of the facet on the other
/// side, in whatever direction it has the edge; -1 where an edge does not have exactly two facets. O(#F log #F).
std::vector<std::int32_t> edge_partners(const std::vector<Triangle>& facets);

}  // namespace kerf
