// Which facets belong together at the edges where more than two meet.
#pragma once

#include <vector>

#include "surface/soup.h"

namespace kerf {

/// Two or more facets at an edge.
struct CrowdedEdge {
    std::int32_t low, high;             ///< its ends
    std::vector<std::int32_t> corners;  ///< paired: 0 with 1, 2 with 3, ..., the material between them
    bool is_paired = false;
    const char* reason = "";  ///< why not
};

struct EdgePairs {
    std::vector<std::int32_t>
        partner;                ///< 3 #F; the corner across the edge, in whatever direction; -1: none, or unpaired
    std::vector<char> is_open;  ///< 3 #F; the edge has no other facet
    std::vector<CrowdedEdge> crowded;  ///< edges of more than two facets, ascending
};

/// Edges of two facets say themselves who are partners. At others the facets are sorted around the edge, by exact
/// signs, and two are partners that have material between them, if all go together in this way: pairs lie beside or
/// within each other, as brackets do.
/// Requires finite coordinates and no facet with a repeated vertex. O(#F), and O(k log k) at an edge of k facets.
EdgePairs pair_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Facets around the vertices, in fans: two corners of facets at a vertex are in one fan if edges of two facets, pairs
/// or unpaired edges lead from one to the other. A root of a union-find per corner (3 #F), the smallest of its fan.
std::vector<std::int32_t> find_fans(const std::vector<Triangle>& facets, const EdgePairs& pairs);

}  // namespace kerf
