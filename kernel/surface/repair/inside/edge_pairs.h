// Pairs of facets that belong together at edges of more than two facets.
#pragma once

#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// An edge of more than two facets.
struct CrowdedEdge {
    std::int32_t low, high;             ///< its ends, by number
    std::vector<std::int32_t> corners;  ///< its facets'; if paired, 0 with 1, 2 with 3, ..., the material between them
    bool is_paired = false;
    const char* reason = "";  ///< why it is not paired
};

/// The partners of facets over their edges.
struct EdgePairs {
    std::vector<std::int32_t> partner;  ///< 3 #F; the corner across the edge, either way; -1: none, or unpaired
    std::vector<char> is_open;          ///< 3 #F; the edge has no other facet
    std::vector<CrowdedEdge> crowded;   ///< edges of more than two facets, ascending
};

/// Pairs the facets at each edge. The two facets of an edge of two are partners. At other edges the facets are sorted
/// around the edge, by exact signs, and two are partners that have material between them, provided that all of them go
/// together in this way: pairs lie beside or within each other, as brackets do. Requires finite coordinates and no
/// facet with a repeated vertex. O(#F), and O(k log k) at an edge of k facets.
EdgePairs pair_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Finds the fans of facets around vertices: two corners of facets at a vertex are in one fan if edges of two facets,
/// pairs or unpaired edges lead from one to the other. Returns for each corner (3 #F) the root of its fan, which is its
/// smallest corner.
std::vector<std::int32_t> find_fans(const std::vector<Triangle>& facets, const EdgePairs& pairs);

}  // namespace kerf
