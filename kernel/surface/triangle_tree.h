// What of a set of triangles is near a point: a hierarchy of boxes over triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/box_hierarchy.h"
#include "geometry/ray.h"

namespace kerf {

/// The closest point of triangle a, b, c to p. Right for needles, whatever their height: there the edges decide,
/// because the plane of the triangle is lost to rounding.
Vec3 closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A binary tree over the boxes of triangles, of their pieces where needles lie across the axes, split at the median of
/// the longest side of their centres. Built in O(n log n) on threads, immutable; a query is O(log n) where few
/// triangles are near.
class TriangleTree {
 public:
    struct Closest {
        std::int32_t facet = -1;  ///< -1: none within the limit
        double squared_distance = std::numeric_limits<double>::infinity();
        Vec3 point = Vec3::Zero();  ///< of the facet
    };

    /// Vertex numbers must be in range, coordinates finite.
    TriangleTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

    /// The facet closest to p of those nearer than sqrt(squared_limit); of equally close ones that which the tree meets
    /// first, which depends on the triangles alone.
    Closest closest(const Vec3& p, double squared_limit = std::numeric_limits<double>::infinity()) const;

    /// Calls accept(facet, squared_distance) for facets within `radius` of p, some of them several times, until it
    /// returns true. Returns whether it did.
    template <class Accept>
    bool any_within(const Vec3& p, double radius, Accept accept) const {
        const double limit = radius * radius;
        return hierarchy_.any([&](const BoxNode& node) { return !(node.box.squaredExteriorDistance(p) > limit); },
                              [&](std::int32_t i) {
                                  const double squared = squared_distance(p, i);
                                  return squared <= limit && accept(order_[i], squared);
                              });
    }

    /// Distance along the ray from `origin` in `direction` (any length, which is the unit of the distance) to the first
    /// triangle it meets beyond `from` that accept(facet) takes; infinity: none up to `to`. Not exact: rays through
    /// edges may pass.
    template <class Accept>
    double first_hit(const Vec3& origin, const Vec3& direction, double from, double to, Accept accept) const {
        double nearest = std::numeric_limits<double>::infinity();
        const auto may_be_hit = [&](const BoxNode& node) {
            const RayPiece piece = piece_in_box(node.box, origin, direction, {from, std::min(to, nearest)});
            return piece.from <= piece.to;
        };
        hierarchy_.any(may_be_hit, [&](std::int32_t i) {
            const auto& [a, b, c] = corners_[i];
            const double t = line_triangle_distance(origin, direction, a, b, c);
            if (t > from && t < to && t < nearest && accept(order_[i])) nearest = t;
            return false;
        });
        return nearest;
    }

    double squared_distance_to(const Vec3& p, std::int32_t facet) const { return squared_distance(p, place_[facet]); }
    const std::array<Vec3, 3>& corners(std::int32_t facet) const { return corners_[place_[facet]]; }

 private:
    double squared_distance(const Vec3& p, std::int32_t place) const;

    std::vector<std::array<Vec3, 3>> corners_;  // in the order of the leaves; several times where pieces have boxes
    std::vector<std::int32_t> order_;           // their facets
    std::vector<std::int32_t> place_;           // of each facet, somewhere in order_
    BoxHierarchy<> hierarchy_;
};

}  // namespace kerf
