// All pairs of facets that meet elsewhere than in the vertices and edges that they share.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Two facets, the smaller number first.
using FacetPair = std::array<std::int32_t, 2>;

/// Returns the pairs that triangles_intersect() is true for and of which at least one facet is `changed` (#F),
/// ascending; the search ends where there are more than `most`. Facets have area. Expected O(#F log #F), 100 bytes a
/// changed facet.
std::vector<FacetPair> crossing_pairs(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                      const std::vector<char>& changed, std::size_t most,
                                      const std::function<void()>& check_cancelled);

}  // namespace kerf
