// Vertices, edges and facets that become one because roundings would make them cross otherwise.
#pragma once

#include <functional>

#include "surface/arrange/inside/divided_facets.h"

namespace kerf {

/// Joins what is near around the given facets: vertices within `tolerance` of each other, and all of a chain of such,
/// become one, of which the smallest number stays; then edges are divided at vertices within the tolerance of them, and
/// facets at vertices above them, until nothing is as near, or after 100 passes. Facets with the same edge are divided
/// alike, so a surface that was closed stays closed. Nothing moves farther than a small multiple of the tolerance,
/// except vertices of chains, which move along these: callers that bound moves must look at the result.
///
/// `is_near` (#F): the given facets; the facets that come of them, and all others that have to be divided, are
/// `changed` then. Returns the largest distance of a vertex with a number below `given` from the one that it became.
double join_near_features(DividedFacets& divided, std::vector<char> is_near, double tolerance, std::size_t given,
                          const std::function<void()>& check_cancelled);

}  // namespace kerf
