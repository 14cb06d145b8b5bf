// The point of a segment or triangle that is closest to another point.
#pragma once

#include "base/core/types.h"

namespace kerf {

/// Returns the point of segment ab closest to p; an end, where that is closest, bit for bit.
inline Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double t = along.dot(p - a), length_sq = along.squaredNorm();
    return t <= 0 ? a : t >= length_sq ? b : Vec3(a + t / length_sq * along);
}

/// Returns the barycentric coordinates of the point of triangle a, b, c closest to p, none negative, with the sum 1; by
/// the regions of the triangle (Ericson 2005, section 5.1.5, ericson2005). Requires three different corners.
inline Vec3 closest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double b_from_a = ab.dot(p - a), c_from_a = ac.dot(p - a);
    if (b_from_a <= 0 && c_from_a <= 0) return {1, 0, 0};
    const double b_from_b = ab.dot(p - b), c_from_b = ac.dot(p - b);
    if (b_from_b >= 0 && c_from_b <= b_from_b) return {0, 1, 0};
    const double b_from_c = ab.dot(p - c), c_from_c = ac.dot(p - c);
    if (c_from_c >= 0 && b_from_c <= c_from_c) return {0, 0, 1};

    const double on_ab = b_from_a * c_from_b - b_from_b * c_from_a;
    if (on_ab <= 0 && b_from_a >= 0 && b_from_b <= 0) {
        const double t = b_from_a / (b_from_a - b_from_b);
        return {1 - t, t, 0};
    }
    const double on_ac = b_from_c * c_from_a - b_from_a * c_from_c;
    if (on_ac <= 0 && c_from_a >= 0 && c_from_c <= 0) {
        const double t = c_from_a / (c_from_a - c_from_c);
        return {1 - t, 0, t};
    }
    const double on_bc = b_from_b * c_from_c - b_from_c * c_from_b;
    const double to_c = c_from_b - b_from_b, to_b = b_from_c - c_from_c;
    if (on_bc <= 0 && to_c >= 0 && to_b >= 0) {
        const double t = to_c / (to_c + to_b);
        return {0, 1 - t, t};
    }
    const double sum = on_ab + on_ac + on_bc;
    return {on_bc / sum, on_ac / sum, on_ab / sum};
}

/// Returns the distance of p from triangle a, b, c, which must have three different corners.
inline double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 t = closest_barycentric(p, a, b, c);
    return (p - t[0] * a - t[1] * b - t[2] * c).norm();
}

}  // namespace kerf
