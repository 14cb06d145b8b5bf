// The order of the facets around their common edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/soup/edge_corners.h"

namespace kerf {

/// The reason why facets at an edge have no order.
enum class RadialDefect {
    none,
    no_area,     ///< one of them is a segment
    coincident,  ///< two of them lie on one another
};

struct RadialOrder {
    std::vector<std::int32_t> corners;  ///< counter-clockwise seen from the larger end of the edge; empty at a defect
    RadialDefect defect = RadialDefect::none;
};

/// Sorts the corners at one edge, as EdgeCorners gives them with the smaller end `low`, by the directions of their
/// facets, beginning with the first corner. Exact signs decide. O(k log k) for k corners.
RadialOrder radial_order(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, std::int32_t low,
                         std::span<const EdgeCorners::Corner> corners);

/// Whether the back of the facet at a corner, not its front, lies ahead of it in the sense of radial_order() around the
/// edge with the smaller end `low`.
inline bool has_back_ahead(const std::vector<Triangle>& facets, std::int32_t low, std::int32_t corner) {
    return start_vertex(facets, corner) != low;
}

/// The numbers of the two sides of facet f: 2 f for its front, 2 f + 1 for its back.
constexpr std::int32_t front_side(std::int32_t facet) { return 2 * facet; }
constexpr std::int32_t back_side(std::int32_t facet) { return 2 * facet + 1; }

/// The sides of a facet seen by one who turns around an edge of it in the sense of radial_order(): `behind` is met
/// first, `ahead` is left last. Between a facet and the next one lie the side ahead of the former and the side behind
/// the latter.
struct EdgeSides {
    std::int32_t ahead, behind;
};

/// Returns the sides of the facet of a corner at the edge with the smaller end `low`, in the sense of radial_order().
inline EdgeSides sides_at(const std::vector<Triangle>& facets, std::int32_t low, std::int32_t corner) {
    const std::int32_t f = corner / 3;
    if (has_back_ahead(facets, low, corner)) return {back_side(f), front_side(f)};
    return {front_side(f), back_side(f)};
}

}  // namespace kerf
