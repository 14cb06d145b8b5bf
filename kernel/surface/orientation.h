// Consistent, outward orientation of a closed triangle soup.
#pragma once

#include "surface/soup.h"

namespace kerf {

/// Facets that edges of exactly two facets connect form a shell. Which of them have to be turned to agree with their
/// neighbours over these edges, so that such an edge is ij in one and ji in the other: the orientation of the majority
/// of a shell stays.
struct FacetShells {
    std::vector<std::int32_t> shell;  ///< #F; numbered by smallest facet
    std::int32_t shell_count = 0;
    std::vector<std::int32_t> turned;          ///< facets to be turned, ascending
    std::vector<std::int32_t> contradictions;  ///< per one-sided shell the first facet that disagrees for any choice
};

/// `partner`: edge_partners(facets). Requires indices in range and no facet with a repeated vertex; any number of
/// facets at an edge. O(#F), on threads where all agree.
FacetShells find_facet_shells(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner);

/// Facets that agree with their neighbours.
struct ConsistentFacets : FacetShells {
    std::vector<Triangle> facets;  ///< #F; corners 1 and 2 exchanged where turned
};

/// Requirements and cost as above.
ConsistentFacets make_consistent(const std::vector<Triangle>& facets);

/// How a closed shell lies among the others.
struct ShellPlace {
    std::int32_t first_facet = 0;
    std::int32_t depth = 0;     ///< number of shells around it; odd: a void
    std::int32_t parent = -1;   ///< the innermost shell around it
    std::int32_t touches = -1;  ///< a shell that it meets, so that depth and parent are unknown
    bool outward = true;        ///< encloses positive volume
    bool has_hole = false;      ///< the innermost shell around a point that is said to lie in a void

    /// A void should be turned against its parent. One that is not may be meant as a second body.
    bool ambiguous(const std::vector<ShellPlace>& shells) const {
        return parent >= 0 && !has_hole && shells[parent].outward == outward;
    }
};

/// Places of the shells of facets that agree, in their order. Requires closed shells. `holes`: points in voids. The
/// nesting depth is found by ray parity. O(#F log #F) plus, for every box in others, a question to that of the
/// innermost shell around it and to those of smaller ones, on threads. Shells that meet get some place or other, but no
/// error. Deterministic.
std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                      const FacetShells& shells, const std::vector<Vec3>& holes = {});
inline std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const ConsistentFacets& consistent) {
    return locate_shells(vertices, consistent.facets, consistent);
}

/// What orient() turned.
struct OrientationReport {
    std::int64_t facets_flipped = 0;  ///< facets turned to agree with the rest of their shell
    std::int64_t shells_flipped = 0;  ///< shells turned as a whole: outside out, void shells into the void
    std::int64_t shells = 0;
};

/// What turns the facets of a soup so that normals point out of the material everywhere.
struct Orientation {
    std::vector<std::int32_t> turned;  ///< corners 1 and 2 of these facets are to be exchanged; ascending
    OrientationReport report;
};

/// Within a shell the majority decides. Between shells the nesting depth decides: even depth outward, odd depth (a
/// void) inward. Requires shells without contradictions that do not meet. O(#F).
Orientation find_orientation(const FacetShells& shells, const std::vector<ShellPlace>& places);

/// Exchanges corners 1 and 2 of these facets.
void turn_facets(std::vector<Triangle>& facets, const std::vector<std::int32_t>& turned);

/// Turns facets as find_orientation() says. Requires every edge to have exactly two facets and shells that do not
/// meet; throws Error(input) for a shell that is not orientable or that meets another, naming a facet. Cost as
/// locate_shells().
OrientationReport orient(Soup& soup);

}  // namespace kerf
