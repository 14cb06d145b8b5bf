// A measure of how far a cell is from flat, as one number that is cheap to compare.
//
// The measure is the smallest sine of the six dihedral angles, which sees small angles and large ones alike. It is kept
// as the square of the cotangent with the sign of the cotangent: that needs no root and no trigonometry, and falls
// monotonically as the angle grows from 0 to 180 degrees. See fill/mesh/quality.cpp for the formula.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/geometry/vector_pair.h"

namespace kerf {

/// Returns the square of x with the sign of x.
inline double signed_square(double x) { return x * std::abs(x); }

/// Returns the angle in (0, 180) degrees with this signed square of its cotangent.
inline double degrees_from_square(double square) {
    const double cotangent = std::copysign(std::sqrt(std::abs(square)), square);
    return std::atan2(1.0, cotangent) * (180 / std::numbers::pi);
}

inline double square_from_degrees(double angle_deg) {
    return signed_square(1 / std::tan(angle_deg * (std::numbers::pi / 180)));
}

struct CellShape {
    double sharpest;     ///< signed square of the cotangent of the smallest dihedral angle
    double flattest;     ///< signed square of the cotangent of 180 degrees less the largest one
    double six_volumes;  ///< six times the volume, signed

    /// Returns the badness of the cell; smaller is better: 1/8 for the regular tetrahedron, infinity where the volume
    /// is not positive.
    double badness() const { return std::max(sharpest, flattest); }
};

/// A tetrahedron from which several measures are asked that have much in common.
class CellGeometry {
 public:
    CellGeometry(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) : CellGeometry({a, b}, {c, d}) {}

    /// Returns six times the volume, signed.
    double six_volumes() const { return six_volumes_; }
    double shortest_edge_sq() const { return smallest_of(smallest(smallest(ad_bc_sq_, ac_bd_sq_), cd_ab_sq_)); }
    /// Returns the squared circumradius, times the square of 2 * six_volumes().
    double scaled_circumradius_sq() const {
        const Pair ac_ad_sq = firsts(ac_bd_sq_, ad_bc_sq_);
        const auto sum = [&](Pair n1_n0, Pair n2_n3) {
            const Pair products = ac_ad_sq * n2_n3;
            return cd_ab_sq_[1] * n1_n0[0] + products[0] + products[1];
        };
        const double x = sum(n1_n0_.x, n2_n3_.x), y = sum(n1_n0_.y, n2_n3_.y), z = sum(n1_n0_.z, n2_n3_.z);
        return x * x + y * y + z * z;
    }

    CellShape shape() const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (!(six_volumes_ > 0)) return {infinity, infinity, six_volumes_};
        const double scale = 1 / six_volumes_;  // applied at once, because the eighth power of a length may overflow
        // Returns the signed squares for the angles at two edges, from the dot products of the faces there.
        const auto squares = [&](Pair products, Pair lengths_sq) {
            const Pair cosines = products * scale;
            return cosines * absolute(cosines) / lengths_sq;
        };
        const Pair at_ad_bc = squares(n1_n0_.dot(n2_n3_), ad_bc_sq_);
        const Pair at_ac_bd = squares(n1_n0_.dot(swapped(n2_n3_)), ac_bd_sq_);
        const Pair at_cd_ab = squares(firsts(n1_n0_, n2_n3_).dot(seconds(n1_n0_, n2_n3_)), cd_ab_sq_);
        return {largest_of(largest(largest(-at_ad_bc, -at_ac_bd), -at_cd_ab)),
                largest_of(largest(largest(at_ad_bc, at_ac_bd), at_cd_ab)), six_volumes_};
    }

 private:
    CellGeometry(const VectorPair& ab, const VectorPair& cd)
        : CellGeometry(swapped(cd) - ab, cd - ab, seconds(cd, ab) - firsts(cd, ab)) {}
    CellGeometry(const VectorPair& ad_bc, const VectorPair& ac_bd, const VectorPair& cd_ab)
        : n1_n0_(ad_bc.cross(ac_bd)),
          n2_n3_(seconds(cd_ab, swapped(ac_bd)).cross(firsts(ad_bc, swapped(cd_ab)))),
          ad_bc_sq_(ad_bc.squared_norm()),
          ac_bd_sq_(ac_bd.squared_norm()),
          cd_ab_sq_(cd_ab.squared_norm()),
          six_volumes_(-cd_ab.dot(swapped(n1_n0_))[1]) {}

    VectorPair n1_n0_, n2_n3_;  // twice the areas, as vectors, of the faces opposite to the corners, by number
    Pair ad_bc_sq_, ac_bd_sq_, cd_ab_sq_;  // squared lengths of edges, by the letters of their ends
    double six_volumes_;
};

/// Returns the shape of the cell with these corners. About 15 ns.
inline CellShape cell_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return CellGeometry(a, b, c, d).shape();
}

}  // namespace kerf
