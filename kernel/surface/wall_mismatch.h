// Bodies that nearly share walls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Where two closed bodies lie upon each other, or nearly, without having the same facets there.
struct WallMismatch {
    enum class Kind {
        gap,      ///< a thin space that belongs to none of them
        overlap,  ///< each has a part of the other in it
        unlike,   ///< they touch, but their facets, or edges, are not the same
    };
    Kind kind;
    std::array<std::int32_t, 2> bodies;  ///< ascending
    std::vector<std::int32_t> facets;    ///< of both; those at `where` first, then the others, ascending
    Vec3 where;                          ///< where the distance is largest, or a place where they meet
    double distance;                     ///< the widest gap; how deep a body reaches into the other
    double least_share = 0;              ///< of gaps: the smallest one, by the longest edge of the finer facet there
};

/// Facets of two bodies that face each other, and of which no point above the other is further away than `share` of the
/// longest edge of the finer one. One result for each two bodies, ascending. `facets`: not degenerate, not meeting, the
/// space that belongs to no body in front of them, behind them body[f]; facets with a body on either side are left out.
/// What lies back to back, as the two sides of a thin wall do, is no gap. Expected O(#F log #F), deterministic.
std::vector<WallMismatch> find_gaps(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                    const std::vector<std::int32_t>& body, double share);

/// Bodies whose facets intersect. Those that lie flat upon each other but for a tenth of their longest edge, as the two
/// triangulations of a curved face do, are unlike walls, all else are overlaps; how deep these are is measured at the
/// corners and centroids of facets and where edges pass through facets. Facets that both bodies have are no mismatch.
/// `facets`: those of each body are closed and free of intersections. One result for each two bodies, ascending. O(#F
/// log #F) plus the time of find_self_intersections(), and a question to a body for each of these points in its box;
/// deterministic.
std::vector<WallMismatch> find_overlaps(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                        const std::vector<std::int32_t>& body);

}  // namespace kerf
