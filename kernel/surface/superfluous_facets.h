// Facets that can be left out without changing the body.
#pragma once

#include <vector>

#include "core/types.h"

namespace kerf {

/// Copies of one facet: three equal vertices, in whatever order. Ascending.
struct FacetCopies {
    std::vector<std::int32_t> facets;
    std::int32_t keep =
        -1;  ///< so many stay, 0 or 1, and the edges around them have two facets each; -1: no such number
    std::int32_t shell = -1;  ///< coincident shell that they belong to, else -1
};

struct SuperfluousFacets {
    std::vector<std::int32_t> repeated_vertex;  ///< facets that use a vertex twice: nothing is lost with them
    std::vector<FacetCopies> copies;            ///< ordered by first facet
    /// Per shell of which every facet has copies, all these facets: which of the bodies is meant cannot be told.
    std::vector<std::vector<std::int32_t>> coincident_shells;
};

/// `partner`: edge_partners(facets). O(#F) on threads, and O(n log n) for the n facets that may be copies. Exact, as
/// only numbers of vertices are compared.
SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets,
                                          const std::vector<std::int32_t>& partner);
SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets);

}  // namespace kerf
