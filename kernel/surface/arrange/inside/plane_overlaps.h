// Facets that lie on one another up to roundings.
#pragma once

#include <functional>
#include <vector>

#include "surface/arrange/inside/crossing_pairs.h"
#include "surface/arrange/inside/divided_facets.h"

namespace kerf {

/// Returns all pairs of facets that lie in one plane within `tolerance` and share area, and of which one is near,
/// ascending. `is_near` (#F): facets of these pairs become near, too, and so on. Expected O(#F log #F).
std::vector<FacetPair> plane_overlaps(const DividedFacets& divided, std::vector<char>& is_near, double tolerance,
                                      const std::function<void()>& check_cancelled);

}  // namespace kerf
