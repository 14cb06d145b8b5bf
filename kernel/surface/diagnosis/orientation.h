// Consistent, outward orientation of a closed triangle soup.
#pragma once

#include "surface/soup/soup.h"

namespace kerf {

/// The shells of a set of facets, and the facets to be turned so that neighbours agree. A shell is a set of facets
/// connected by edges of exactly two facets; neighbours agree over such an edge if it is ij in one and ji in the other.
/// The orientation of the majority of a shell stays.
struct FacetShells {
    std::vector<std::int32_t> shell;  ///< #F; numbered by smallest facet
    std::int32_t shell_count = 0;
    std::vector<std::int32_t> turned;          ///< facets to be turned, ascending
    std::vector<std::int32_t> contradictions;  ///< per one-sided shell the first facet that disagrees, whichever way it
                                               ///< is turned
};

/// Finds the shells, given partner = edge_partners(facets). Requires indices in range and no facet with a repeated
/// vertex; any number of facets may meet at an edge. O(#F), on threads where all facets agree.
FacetShells find_facet_shells(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner);

/// Facets turned so that they agree with their neighbours.
struct ConsistentFacets : FacetShells {
    std::vector<Triangle> facets;  ///< #F; corners 1 and 2 exchanged where turned
};

/// Turns facets so that they agree. Requirements as find_facet_shells(), cost as edge_partners() and
/// find_facet_shells().
ConsistentFacets make_consistent(const std::vector<Triangle>& facets);

/// The place of a closed shell among the others.
struct ShellPlace {
    std::int32_t first_facet = 0;
    std::int32_t depth = 0;     ///< number of shells around it; odd: a void
    std::int32_t parent = -1;   ///< the innermost shell around it
    std::int32_t touches = -1;  ///< a shell that it meets, so that depth and parent are unknown; -1: none
    bool outward = true;        ///< normals point out: it encloses positive volume
    bool has_hole = false;      ///< it is the innermost shell around a point that is said to lie in a void

    /// Whether the shell may be meant as a void or as a second body: it is turned like its parent.
    bool ambiguous(const std::vector<ShellPlace>& shells) const {
        return parent >= 0 && !has_hole && shells[parent].outward == outward;
    }
};

/// Returns the places of the shells of consistent facets, in the order of the shells. Requires closed shells. `holes`
/// are points in voids. Ray parity tells the nesting depth. O(#F log #F) plus, for every shell whose box lies in
/// others, questions to the innermost shell around it and to the shells of smaller boxes; on threads. Shells that meet
/// get an unspecified place, but no error. Deterministic.
std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                      const FacetShells& shells, const std::vector<Vec3>& holes = {});
inline std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const ConsistentFacets& consistent) {
    return locate_shells(vertices, consistent.facets, consistent);
}

/// The numbers of facets and shells that orient() has turned.
struct OrientationReport {
    std::int64_t facets_flipped = 0;  ///< facets turned to agree with the rest of their shell
    std::int64_t shells_flipped = 0;  ///< shells turned as a whole: outside out, void shells into the void
    std::int64_t shells = 0;
};

/// The facets to be turned so that normals point out of the material everywhere.
struct Orientation {
    std::vector<std::int32_t> turned;  ///< corners 1 and 2 of these facets are to be exchanged; ascending
    OrientationReport report;
};

/// Decides which facets to turn: within a shell by the majority, between shells by the nesting depth: even depth
/// outward, odd depth (a void) inward. Requires shells without contradictions that do not meet. O(#F).
Orientation find_orientation(const FacetShells& shells, const std::vector<ShellPlace>& places);

/// Exchanges corners 1 and 2 of the facets `turned`.
void turn_facets(std::vector<Triangle>& facets, const std::vector<std::int32_t>& turned);

/// Turns facets as find_orientation() says. Requires every edge to have exactly two facets and shells that do not
/// meet; throws Error(input) for a shell that is not orientable or that meets another, naming a facet. Cost as
/// locate_shells().
OrientationReport orient(Soup& soup);

}  // namespace kerf
