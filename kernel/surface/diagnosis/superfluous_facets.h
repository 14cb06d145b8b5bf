// Facets that can be left out without changing the body.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The copies of one facet, ascending: facets with the same three vertices, in whatever order.
struct FacetCopies {
    std::vector<std::int32_t> facets;
    std::int32_t keep =
        -1;  ///< number of copies to keep, 0 or 1, so that the edges around have two facets each; -1: none will do
    std::int32_t shell = -1;  ///< coincident shell that the copies belong to, or -1
};

struct SuperfluousFacets {
    std::vector<std::int32_t> repeated_vertex;  ///< facets that use a vertex twice, with which no area is lost
    std::vector<FacetCopies> copies;            ///< ordered by first facet
    /// For each shell of which every facet has copies, all these facets. Nothing tells which of the copies is meant.
    std::vector<std::vector<std::int32_t>> coincident_shells;
};

/// Finds the facets that can be left out. `partner` is edge_partners(facets). O(#F) on threads, and O(n log n) for the
/// n facets that may be copies. Exact, as only numbers of vertices are compared.
SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets,
                                          const std::vector<std::int32_t>& partner);
SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets);

}  // namespace kerf
