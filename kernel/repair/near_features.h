// Vertices, edges and facets that lie so near that roundings make them cross become one.
#pragma once

#include <functional>

#include "repair/divided_facets.h"

namespace kerf {

/// Around facets: joins vertices within `tolerance` of each other, of chains of them all, the smallest number stays;
/// then divides edges at vertices within it, and facets at vertices above them, until nothing is as near, or very
/// often. Facets with the same edge are divided alike, so what was closed stays closed. Nothing moves farther than a
/// small multiple of the tolerance, but for vertices of chains, which move along these: who bounds moves looks at what
/// is returned.
///
/// `is_near` (#F): the facets; those that come of them, and all others that have to be divided, are `changed` then.
/// Returns how far a vertex with a number below `given` was from that which it became, at most.
double join_near_features(DividedFacets& divided, std::vector<char> is_near, double tolerance, std::size_t given,
                          const std::function<void()>& poll);

}  // namespace kerf
