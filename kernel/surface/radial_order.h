// The facets at an edge, in the order in which one meets them going around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/edge_corners.h"

namespace kerf {

/// Why facets at an edge have no order.
enum class RadialDefect {
    none,
    no_area,     ///< one of them is a segment
    coincident,  ///< two of them lie on one another
};

struct RadialOrder {
    std::vector<std::int32_t> corners;  ///< counter-clockwise seen from the larger end of the edge; empty if a defect
    RadialDefect defect = RadialDefect::none;
};

/// Sorts the corners at one edge, as EdgeCorners has them with the smaller end `low`, by the directions of their
/// facets. It begins with the first corner. Decided by exact signs. O(k log k).
RadialOrder radial_order(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, std::int32_t low,
                         std::span<const EdgeCorners::Corner> corners);

/// Whether turning on from a facet around the edge with the smaller end `low`, in the sense of radial_order(), one
/// comes to its back, not to its front.
inline bool has_back_ahead(const std::vector<Triangle>& facets, std::int32_t low, std::int32_t corner) {
    return start_vertex(facets, corner) != low;
}

/// Numbers for the two sides of each facet.
constexpr std::int32_t front_side(std::int32_t facet) { return 2 * facet; }
constexpr std::int32_t back_side(std::int32_t facet) { return 2 * facet + 1; }

/// The sides of a facet that one leaves and meets when turning on around an edge of it: between a facet and the next
/// one lie the side ahead of the one and the side behind the other.
struct EdgeSides {
    std::int32_t ahead, behind;
};

/// Of the facet of a corner at the edge with the smaller end `low`, in the sense of radial_order().
inline EdgeSides sides_at(const std::vector<Triangle>& facets, std::int32_t low, std::int32_t corner) {
    const std::int32_t f = corner / 3;
    if (has_back_ahead(facets, low, corner)) return {back_side(f), front_side(f)};
    return {front_side(f), back_side(f)};
}

}  // namespace kerf
