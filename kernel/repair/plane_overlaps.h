// Facets that lie on one another, but for roundings.
#pragma once

#include <functional>
#include <vector>

#include "repair/crossing_pairs.h"
#include "repair/divided_facets.h"

namespace kerf {

/// All pairs that lie in one plane within `tolerance` and share area, of which one is near, ascending. `is_near` (#F):
/// facets that are found become near, too, and so on. Expected O(#F log #F).
std::vector<FacetPair> plane_overlaps(const DividedFacets& divided, std::vector<char>& is_near, double tolerance,
                                      const std::function<void()>& poll);

}  // namespace kerf
