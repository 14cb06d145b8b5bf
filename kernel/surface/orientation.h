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
    std::int64_t turned = 0;          ///< number of facets turned
    std::int32_t contradiction = -1;  ///< first facet that disagrees for any choice: its shell is not orientable
};

/// Requires indices in range and no facet with a repeated vertex; any number of facets at an edge. O(#F log #F).
ConsistentFacets make_consistent(const std::vector<Triangle>& facets);

/// What orient() turned.
struct OrientationReport {
    std::int64_t facets_flipped = 0;  ///< facets turned to agree with the rest of their shell
    std::int64_t shells_flipped = 0;  ///< shells turned as a whole: outside out, void shells into the void
    std::int64_t shells = 0;
    std::int64_t void_shells = 0;
};

/// Turns facets until normals point out of the material everywhere.
///
/// Within a shell the orientation is propagated by make_consistent(). Between shells the nesting depth by ray parity
/// decides: even depth outward, odd depth (a void) inward. Requires every edge to have exactly two facets and shells
/// that do not meet; throws Error(input) for a shell that is not orientable or that meets another, naming a facet.
/// Deterministic. O(#F log #F) plus O(#shells x #F) for shells whose bounding boxes are nested.
OrientationReport orient(Soup& soup);

}  // namespace kerf
