// Intersections of rays with triangles and boxes, to the precision of doubles: a ray may pass through an edge.
#pragma once

#include <algorithm>
#include <limits>

#include "base/geometry/box.h"

namespace kerf {

/// Returns the distance along the line through `origin` to the triangle a, b, c, which it may hit from either side, in
/// lengths of `direction`, negative behind the origin; infinity if it misses (Möller and Trumbore 1997, moeller1997).
inline double line_triangle_distance(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b,
                                     const Vec3& c) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const Vec3 ab = b - a, ac = c - a, across = direction.cross(ac);
    const double determinant = ab.dot(across);
    if (determinant == 0) return none;
    const Vec3 from_a = origin - a;
    const double u = from_a.dot(across) / determinant;
    if (!(u >= 0 && u <= 1)) return none;
    const Vec3 turned = from_a.cross(ab);
    const double v = direction.dot(turned) / determinant;
    return v >= 0 && u + v <= 1 ? ac.dot(turned) / determinant : none;
}

/// A piece of a ray, in lengths of its direction; empty if `from` is beyond `to`.
struct RayPiece {
    double from = 0, to = std::numeric_limits<double>::infinity();
};

/// Returns the part of a piece of a ray that lies in the box.
inline RayPiece piece_in_box(const Box& box, const Vec3& origin, const Vec3& direction, RayPiece piece) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis]) return {infinity, -infinity};
            continue;
        }
        const double s = (box.min()[axis] - origin[axis]) / direction[axis];
        const double t = (box.max()[axis] - origin[axis]) / direction[axis];
        piece.from = std::max(piece.from, std::min(s, t));
        piece.to = std::min(piece.to, std::max(s, t));
    }
    return piece;
}

}  // namespace kerf
