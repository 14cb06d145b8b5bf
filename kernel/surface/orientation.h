// Consistent, outward orientation of a closed triangle soup.
#pragma once

#include "surface/soup.h"

namespace kerf {

/// Facets made to agree with their neighbours over edges of exactly two facets: such an edge is ij in one and ji in the
/// other. Facets that these edges connect form a shell; the orientation of its majority stays.
struct ConsistentFacets {
    std::vector<Triangle> facets;     ///< #F; corners 1 and 2 exchanged where turned
    std::vector<std::int32_t> shell;  ///< #F; numbered by smallest facet
    std::int32_t shell_count = 0;
    std::vector<std::int32_t> turned;          ///< facets turned, ascending
    std::vector<std::int32_t> contradictions;  ///< per one-sided shell the first facet that disagrees for any choice
};

/// Requires indices in range and no facet with a repeated vertex; any number of facets at an edge. O(#F log #F).
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

/// Places of the shells of `consistent`, in their order. Requires closed shells. `holes`: points in voids. The nesting
/// depth is found by ray parity. O(#F log #F) plus, for every box in others, a question to that of the innermost shell
/// around it and to those of smaller ones. Shells that meet get some place or other, but no
/// error. Deterministic.
std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const ConsistentFacets& consistent,
                                      const std::vector<Vec3>& holes = {});

/// What orient() turned.
struct OrientationReport {
    std::int64_t facets_flipped = 0;  ///< facets turned to agree with the rest of their shell
    std::int64_t shells_flipped = 0;  ///< shells turned as a whole: outside out, void shells into the void
    std::int64_t shells = 0;
};

/// Turns facets until normals point out of the material everywhere.
///
/// Within a shell the orientation is propagated by make_consistent(). Between shells the nesting depth decides: even
/// depth outward, odd depth (a void) inward. Requires every edge to have exactly two facets and shells that do not
/// meet; throws Error(input) for a shell that is not orientable or that meets another, naming a facet. Cost as
/// locate_shells().
OrientationReport orient(Soup& soup);

}  // namespace kerf
