// Areas and normals of triangles.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// Returns (b - a) x (c - a): normal to the triangle, which is counter-clockwise seen from where it points to; its
/// length is twice the area.
inline Vec3 doubled_area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }
inline Vec3 doubled_area_vector(const std::array<Vec3, 3>& corners) {
    return doubled_area_vector(corners[0], corners[1], corners[2]);
}
inline Vec3 doubled_area_vector(const std::vector<Vec3>& vertices, const Triangle& t) {
    return doubled_area_vector(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

/// Returns the normal with the area as its length. `triangle` are the arguments of doubled_area_vector().
template <class... Corners>
Vec3 area_vector(const Corners&... triangle) {
    return doubled_area_vector(triangle...) / 2;
}

template <class... Corners>
double triangle_area(const Corners&... triangle) {
    return doubled_area_vector(triangle...).norm() / 2;
}

/// The largest circle in a triangle.
struct InscribedCircle {
    Vec3 centre;
    Vec3 normal;  ///< normal of the triangle, with the radius as its length
};
inline InscribedCircle inscribed_circle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double opposite_a = (c - b).norm(), opposite_b = (a - c).norm(), opposite_c = (b - a).norm();
    const double perimeter = opposite_a + opposite_b + opposite_c;
    return {(opposite_a * a + opposite_b * b + opposite_c * c) / perimeter, doubled_area_vector(a, b, c) / perimeter};
}

}  // namespace kerf
