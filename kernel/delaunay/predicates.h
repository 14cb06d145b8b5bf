// The two signs on which a Delaunay triangulation rests, never wrong: fast where rounding errors cannot change them, by
// exact arithmetic elsewhere.
//
// The filters are bounds of Shewchuk's kind (shewchuk1997), with the products of the largest differences along each axis
// in place of the permanents: no term of an expanded determinant goes through more roundings than `roundings`, so the
// error is below roundings * 2^-53 * (number of terms) * (largest term).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types.h"

namespace kerf {

namespace detail {

/// The sign of the exact determinant.
int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int exact_in_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);
/// What in_sphere() says where the exact determinant is 0.
bool tie_is_inside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

inline int sign_of(double x) { return (x > 0) - (x < 0); }

/// Where the filters hold: no product of five differences, or of fewer, underflows or overflows.
inline constexpr double smallest_safe = 1e-55, largest_safe = 1e55;

inline bool are_safe(double x, double y, double z) {
    return std::min({x, y, z}) > smallest_safe && std::max({x, y, z}) < largest_safe;
}

}  // namespace detail

/// The sign of det[b-a, c-a, d-a]: 1 if d sees a, b, c counter-clockwise, as in every Tetrahedron (core/types.h); 0 if
/// all lie in one plane. Exact. About 5 ns, microseconds near 0.
inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
    const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
    const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
    const double det = ax * (bz * cy - by * cz) + ay * (bx * cz - bz * cx) + az * (by * cx - bx * cy);
    const double x = std::max({std::abs(ax), std::abs(bx), std::abs(cx)});
    const double y = std::max({std::abs(ay), std::abs(by), std::abs(cy)});
    const double z = std::max({std::abs(az), std::abs(bz), std::abs(cz)});
    constexpr double roundings = 9, terms = 6;
    constexpr double relative_error = roundings * terms * 0x1p-53;
    if (std::abs(det) > relative_error * (x * y * z) && detail::are_safe(x, y, z)) return detail::sign_of(det);
    return x == 0 || y == 0 || z == 0 ? 0 : detail::exact_orientation(a, b, c, d);
}

/// Whether e lies inside of the sphere through a, b, c, d, which must have orientation 1.
///
/// Exact. There are no ties: a point on the sphere counts as inside or outside as if every point had been lifted to the
/// paraboloid x^2 + y^2 + z^2 and then raised by an infinitely small height, by far the most the lexicographically
/// largest point (devillers2011). Coordinates do not move, so that cells never become flat, and since the points alone
/// decide, so they do on the triangulation. e must differ from the others. About 15 ns; microseconds near a tie.
inline bool in_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    const double ax = a[0] - e[0], ay = a[1] - e[1], az = a[2] - e[2];
    const double bx = b[0] - e[0], by = b[1] - e[1], bz = b[2] - e[2];
    const double cx = c[0] - e[0], cy = c[1] - e[1], cz = c[2] - e[2];
    const double dx = d[0] - e[0], dy = d[1] - e[1], dz = d[2] - e[2];
    const double ab = ax * by - bx * ay, bc = bx * cy - cx * by, cd = cx * dy - dx * cy;
    const double da = dx * ay - ax * dy, ac = ax * cy - cx * ay, bd = bx * dy - dx * by;
    const double a_lift = ax * ax + ay * ay + az * az, b_lift = bx * bx + by * by + bz * bz;
    const double c_lift = cx * cx + cy * cy + cz * cz, d_lift = dx * dx + dy * dy + dz * dz;
    const double abc = az * bc - bz * ac + cz * ab, bcd = bz * cd - cz * bd + dz * bc;
    const double cda = cz * da + dz * ac + az * cd, dab = dz * ab + az * bd + bz * da;
    const double det = (c_lift * dab - d_lift * abc) + (a_lift * bcd - b_lift * cda);
    const double x = std::max(std::max(std::abs(ax), std::abs(bx)), std::max(std::abs(cx), std::abs(dx)));
    const double y = std::max(std::max(std::abs(ay), std::abs(by)), std::max(std::abs(cy), std::abs(dy)));
    const double z = std::max(std::max(std::abs(az), std::abs(bz)), std::max(std::abs(cz), std::abs(dz)));
    constexpr double roundings = 18, terms = 24;
    constexpr double relative_error = roundings * terms * 0x1p-53;
    const double error = relative_error * (x * y * z) * (x * x + y * y + z * z);
    if (std::abs(det) > error && detail::are_safe(x, y, z)) return det > 0;
    const int sign = detail::exact_in_sphere(a, b, c, d, e);
    return sign == 0 ? detail::tie_is_inside(a, b, c, d, e) : sign > 0;
}

/// Whether the three points lie on one line. Exact, slow.
bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// x first, then y, then z.
inline bool lexicographically_less(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace kerf
