// Angles of triangles and between triangles. There are two ways to compute an angle: by the arc cosine of unit vectors,
// which is short and loses half of the digits near 0 and 180 degrees, and by angle_between(), which is accurate
// everywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// Returns the angle in [0, pi] with this cosine, which rounding may have put beyond 1.
inline double angle_of_cosine(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

inline double degrees_of_cosine(double cosine) { return angle_of_cosine(cosine) * 180 / std::numbers::pi; }

/// Returns the angle at `apex` between the directions to a and b.
inline double angle_degrees(const Vec3& apex, const Vec3& a, const Vec3& b) {
    return degrees_of_cosine((a - apex).normalized().dot((b - apex).normalized()));
}

/// Returns the unit vector in the triangle that is perpendicular to its edge a-b and points towards the apex.
inline Vec3 towards_apex(const Vec3& a, const Vec3& b, const Vec3& apex) {
    const Vec3 edge = (b - a).normalized();
    const Vec3 r = apex - a;
    return (r - r.dot(edge) * edge).normalized();
}

/// Returns the angle in [0, 180] between the triangles a, b, p and a, b, q along their edge a-b; 0 if folded onto each
/// other.
inline double dihedral_degrees(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
    return degrees_of_cosine(towards_apex(a, b, p).dot(towards_apex(a, b, q)));
}

/// Returns the angle in [0, pi] between two vectors of any lengths; 0 if one has the length 0.
inline double angle_between(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

/// Returns the smallest angle of a triangle by angle_between(), in degrees.
inline double smallest_angle_degrees(const std::array<Vec3, 3>& corners) {
    double smallest = 180;
    for (std::size_t i = 0; i < 3; ++i) {
        const double angle = angle_between(corners[(i + 1) % 3] - corners[i], corners[(i + 2) % 3] - corners[i]);
        smallest = std::min(smallest, angle * 180 / std::numbers::pi);
    }
    return smallest;
}

}  // namespace kerf
