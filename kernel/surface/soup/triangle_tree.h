// Finds the triangles near a point, or the first one along a ray, in a hierarchy of boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/geometry/box_hierarchy.h"
#include "base/geometry/ray.h"

namespace kerf {

/// Returns the point of triangle a, b, c closest to p. Right for needles of any height: for these the edges decide,
/// because the plane of the triangle is lost to rounding.
Vec3 closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A binary tree over the boxes of triangles, or of their pieces where needles lie across the axes. It is split at the
/// median of the centres along the longest side of their box. Built in O(n log n) on threads, immutable; a query is
/// O(log n) if few triangles are near.
class TriangleTree {
 public:
    struct Closest {
        std::int32_t facet = -1;  ///< -1: none within the limit
        double squared_distance = std::numeric_limits<double>::infinity();
        Vec3 point = Vec3::Zero();  ///< on the facet
    };

    /// Vertex numbers must be in range, coordinates finite.
    TriangleTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

    /// Returns the facet closest to p of those nearer than sqrt(squared_limit). Of equally close ones it is that which
    /// the tree meets first, which depends on the triangles alone.
    Closest closest(const Vec3& p, double squared_limit = std::numeric_limits<double>::infinity()) const;

    /// Calls accept(facet, squared_distance) for the facets within `radius` of p, for some of them several times, until
    /// it returns true. Returns whether it did.
    template <class Accept>
    bool any_within(const Vec3& p, double radius, Accept accept) const {
        const double limit = radius * radius;
        return hierarchy_.any([&](const BoxNode& node) { return !(node.box.squaredExteriorDistance(p) > limit); },
                              [&](std::int32_t i) {
                                  const double squared = squared_distance(p, i);
                                  return squared <= limit && accept(order_[i], squared);
                              });
    }

    /// Calls accept(facet) for the facets whose boxes, or those of a piece, meet `box`, for some of them several times,
    /// until it returns true. Returns whether it did.
    template <class Accept>
    bool any_in_box(const Eigen::AlignedBox3d& box, Accept accept) const {
        return hierarchy_.any([&](const BoxNode& node) { return node.box.intersects(box); },
                              [&](std::int32_t i) { return accept(order_[i]); });
    }

    /// Returns the distance along the ray to the first triangle between `from` and `to` that accept(facet) takes, or
    /// infinity if there is none. Distances are measured in lengths of `direction`, which is arbitrary. Not exact: a
    /// ray may pass through an edge.
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

    std::vector<std::array<Vec3, 3>> corners_;  // in the order of the leaves; repeated if its pieces have boxes of
                                                // their own
    std::vector<std::int32_t> order_;           // the facet of each of these
    std::vector<std::int32_t> place_;           // #F; a place of the facet in order_
    BoxHierarchy<> hierarchy_;
};

}  // namespace kerf
