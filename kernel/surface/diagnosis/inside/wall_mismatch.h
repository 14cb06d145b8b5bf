// Pairs of bodies whose walls nearly, but not exactly, coincide.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// A place where two closed bodies lie upon each other, or nearly so, without having the same facets.
struct WallMismatch {
    enum class Kind {
        gap,      ///< a thin space that belongs to neither body
        overlap,  ///< each body contains a part of the other
        unlike,   ///< the bodies touch, but their facets, or edges, differ
    };
    Kind kind;
    std::array<std::int32_t, 2> bodies;  ///< ascending
    std::vector<std::int32_t> facets;    ///< facets of both bodies: those at `where`, then the others, ascending
    Vec3 where;                          ///< the point of the largest distance, or a point where the bodies meet
    double distance;                     ///< width of the widest gap, or depth of the overlap
    double least_share = 0;              ///< of a gap: its smallest width over the longest edge of the finer facet
                                         ///< there
};

/// Finds pairs of facets of two bodies that face each other and are nowhere further apart than `share` of the longest
/// edge of the finer one, where one lies above the other. Returns one result for each pair of bodies, ascending.
/// `facets` are not degenerate and do not meet; each has its body, body[f], behind it and no body in front; facets
/// between two bodies are left out. Facets back to back, as on the two sides of a thin wall, are no gap. Expected O(#F
/// log #F), deterministic.
std::vector<WallMismatch> find_gaps(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                    const std::vector<std::int32_t>& body, double share);

/// Finds bodies whose facets intersect. Bodies that lie flat upon each other, up to a tenth of their longest edge, as
/// the two triangulations of a curved face do, are unlike walls, all others are overlaps; their depth is measured at
/// the corners and centroids of facets and where edges pass through facets. Facets that both bodies have are no
/// mismatch. The facets of each body must be closed and free of intersections. Returns one result for each pair of
/// bodies, ascending. O(#F log #F) plus the time of find_self_intersections(), and for each of these points a question
/// to a body whose box contains it; deterministic.
std::vector<WallMismatch> find_overlaps(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                        const std::vector<std::int32_t>& body);

}  // namespace kerf
