// Angles of triangles and between them, in degrees.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/types.h"

namespace kerf {

inline double acos_degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi; }

/// Angle at `apex` between the directions to a and b.
inline double angle_degrees(const Vec3& apex, const Vec3& a, const Vec3& b) {
    return acos_degrees((a - apex).normalized().dot((b - apex).normalized()));
}

/// Unit vector in the triangle, perpendicular to its edge a-b, towards the apex.
inline Vec3 towards_apex(const Vec3& a, const Vec3& b, const Vec3& apex) {
    const Vec3 edge = (b - a).normalized();
    const Vec3 r = apex - a;
    return (r - r.dot(edge) * edge).normalized();
}

/// Angle in [0, 180] between the triangles a, b, p and a, b, q along their edge a-b; 0 if folded onto each other.
inline double dihedral_degrees(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
    return acos_degrees(towards_apex(a, b, p).dot(towards_apex(a, b, q)));
}

}  // namespace kerf
