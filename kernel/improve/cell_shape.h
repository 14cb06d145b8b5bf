// How far a cell is from flat, as one number that is cheap to compare.
//
// The measure is the smallest sine of the six dihedral angles, which sees small angles and large ones alike. It is kept
// as the square of the cotangent with the sign that the cotangent has: that needs no root and no trigonometry, and
// falls monotonically as the angle grows from 0 to 180 degrees. See mesh/quality.cpp for the formula.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "core/types.h"

namespace kerf {

/// The sign of x times its square.
inline double signed_square(double x) { return x * std::abs(x); }

/// The angle in (0, 180) degrees with this signed square of its cotangent.
inline double degrees_from_square(double square) {
    const double cotangent = std::copysign(std::sqrt(std::abs(square)), square);
    return std::atan2(1.0, cotangent) * (180 / std::numbers::pi);
}

inline double square_from_degrees(double angle_deg) {
    return signed_square(1 / std::tan(angle_deg * (std::numbers::pi / 180)));
}

struct CellShape {
    double sharpest;     ///< signed square of the cotangent of the smallest dihedral angle
    double flattest;     ///< the same of the angle that the largest one lacks to 180 degrees
    double six_volumes;  ///< signed

    /// Smaller is better: 1/8 for the regular tetrahedron, infinity where the volume is not positive.
    double badness() const { return std::max(sharpest, flattest); }
};

/// About 25 ns.
inline CellShape cell_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Vec3 u = b - a, v = c - a, w = d - a;
    const Vec3 wv = w.cross(v);
    const double six_volumes = -u.dot(wv);
    if (!(six_volumes > 0)) return {infinity, infinity, six_volumes};
    const Vec3 cd = d - c, bd = d - b, bc = c - b;
    const Vec3 n0 = bc.cross(bd), n2 = u.cross(w), n3 = v.cross(u);
    const std::array<double, 6> cosines = {-n2.dot(n3), -wv.dot(n3), -wv.dot(n2),
                                           -n0.dot(wv), -n0.dot(n2), -n0.dot(n3)};
    const std::array<double, 6> lengths_sq = {u.squaredNorm(),  v.squaredNorm(),  w.squaredNorm(),
                                              cd.squaredNorm(), bd.squaredNorm(), bc.squaredNorm()};
    double largest = -infinity, smallest = infinity;
    const double scale = 1 / six_volumes;  // at once, because the eighth power of a length may be no number
    for (std::size_t k = 0; k < 6; ++k) {
        const double square = signed_square(cosines[k] * scale) / lengths_sq[k];
        largest = std::max(largest, square);
        smallest = std::min(smallest, square);
    }
    return {largest, -smallest, six_volumes};
}

}  // namespace kerf
