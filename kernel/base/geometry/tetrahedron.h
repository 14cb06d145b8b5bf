// Volumes of tetrahedra, to the precision of doubles. Where only the sign matters, orientation() has it exactly.
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// Returns det[b-a, c-a, d-a]: six times the volume, positive for every Tetrahedron (base/core/types.h).
inline double six_volumes_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
}
inline double six_volumes_of(const std::vector<Vec3>& vertices, const Tetrahedron& tet) {
    return six_volumes_of(vertices[tet[0]], vertices[tet[1]], vertices[tet[2]], vertices[tet[3]]);
}

/// Whether the computed volume is positive for every order of the corners: for a cell as thin as rounding it may be
/// positive in one order, and zero or negative in another. Also true if the products underflow.
inline bool has_volume_in_any_order(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    // The error of a determinant is below `doubt` times the product of the largest components of its columns
    // (shewchuk1997), and from another corner these are at most twice as large.
    constexpr double doubt = 6 * 8 * 0x1p-53, underflow = 1e-290;
    const double largest =
        std::max({(b - a).cwiseAbs().maxCoeff(), (c - a).cwiseAbs().maxCoeff(), (d - a).cwiseAbs().maxCoeff()});
    const double product = largest * largest * largest;
    if (six_volumes_of(a, b, c, d) > 9 * doubt * product || product < underflow) return true;
    const auto is_positive = [](const Vec3& from, const Vec3& p, const Vec3& q, const Vec3& r) {
        return six_volumes_of(from, p, q, r) > 0 && six_volumes_of(from, q, r, p) > 0 &&
               six_volumes_of(from, r, p, q) > 0;
    };
    return is_positive(a, b, c, d) && is_positive(b, a, d, c) && is_positive(c, d, a, b) && is_positive(d, c, b, a);
}

}  // namespace kerf
