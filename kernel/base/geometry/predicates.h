// The two signs on which a Delaunay triangulation rests, never wrong: computed fast where rounding errors cannot change
// them, and by exact arithmetic elsewhere.
//
// The filters are bounds of Shewchuk's kind (shewchuk1997), with the products of the largest differences in place of
// the permanents: no term of an expanded determinant goes through more roundings than `roundings`, so the error is
// below roundings * 2^-53 * (number of terms) * (largest term).
#pragma once

#include <algorithm>
#include <cmath>

#include "base/core/types.h"
#include "base/geometry/vector_pair.h"

namespace kerf {

namespace detail {

/// Returns the sign of the exact determinant.
int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Decides in_sphere() where its filter does not.
bool in_sphere_near_tie(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e);

inline int sign_of(double x) { return (x > 0) - (x < 0); }

template <class Number>
using Difference = std::array<Number, 3>;

inline Difference<double> difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// det[a, b, c]; each of its six terms is a product of three.
template <class Number>
auto determinant(const Difference<Number>& a, const Difference<Number>& b, const Difference<Number>& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

template <class Number>
auto lift(const Difference<Number>& a) {
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

// Returns det[a, b, c, d] with the lifts as fourth rows.
template <class Number>
[[gnu::always_inline]] inline auto lifted_determinant(const Difference<Number>& a, const Difference<Number>& b,
                                                      const Difference<Number>& c, const Difference<Number>& d) {
    const auto ab = a[0] * b[1] - b[0] * a[1], bc = b[0] * c[1] - c[0] * b[1], cd = c[0] * d[1] - d[0] * c[1];
    const auto da = d[0] * a[1] - a[0] * d[1], ac = a[0] * c[1] - c[0] * a[1], bd = b[0] * d[1] - d[0] * b[1];
    const auto abc = a[2] * bc - b[2] * ac + c[2] * ab, bcd = b[2] * cd - c[2] * bd + d[2] * bc;
    const auto cda = c[2] * da + d[2] * ac + a[2] * cd, dab = d[2] * ab + a[2] * bd + b[2] * da;
    return (dab * lift(c) - abc * lift(d)) + (bcd * lift(a) - cda * lift(b));
}

// Computes the same determinant in doubles, with a and c in one pair, b and d in the other.
inline double lifted_determinant(const VectorPair& ac, const VectorPair& bd, Pair lift_ac, Pair lift_bd) {
    const VectorPair ca = swapped(ac), db = swapped(bd);
    const Pair ab_cd = ac.x * bd.y - bd.x * ac.y, bc_da = bd.x * ca.y - ca.x * bd.y;
    const Pair ab_x = firsts(ac.x, bd.x), ab_y = firsts(ac.y, bd.y), cd_x = seconds(ac.x, bd.x),
               cd_y = seconds(ac.y, bd.y);
    const Pair ac_bd = ab_x * cd_y - cd_x * ab_y;
    const Pair ca_ac = {-ac_bd[0], ac_bd[0]}, db_bd = {-ac_bd[1], ac_bd[1]};
    const Pair abc_cda = ac.z * bc_da + bd.z * ca_ac + ca.z * ab_cd;
    const Pair bcd_dab = bd.z * swapped(ab_cd) + ca.z * db_bd + db.z * bc_da;
    const Pair terms = bcd_dab * lift_ac - swapped(abc_cda) * lift_bd;
    return terms[0] + terms[1];
}

}  // namespace detail

/// Returns the sign of det[b-a, c-a, d-a]: 1 if d sees a, b, c counter-clockwise, as in every Tetrahedron
/// (base/core/types.h); 0 if all points lie in one plane. Exact. Takes about 5 ns; near 0 a tenth of a microsecond if
/// the coordinates have few bits (see predicates.cpp), else some tenths.
inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto p = detail::difference(a, d), q = detail::difference(b, d), r = detail::difference(c, d);
    const double det = -detail::determinant(p, q, r);
    const double x = std::max({std::abs(p[0]), std::abs(q[0]), std::abs(r[0])});
    const double y = std::max({std::abs(p[1]), std::abs(q[1]), std::abs(r[1])});
    const double z = std::max({std::abs(p[2]), std::abs(q[2]), std::abs(r[2])});
    constexpr double roundings = 9, terms = 6;
    constexpr double relative_error = roundings * terms * 0x1p-53;
    // No product underflows or overflows.
    const bool is_safe = std::min({x, y, z}) > 1e-55 && std::max({x, y, z}) < 1e55;
    if (std::abs(det) > relative_error * (x * y * z) && is_safe) return detail::sign_of(det);
    return x == 0 || y == 0 || z == 0 ? 0 : detail::exact_orientation(a, b, c, d);
}

/// Whether e lies inside of the sphere through a, b, c, d, which must have orientation 1.
///
/// Exact. There are no ties: a point on the sphere counts as inside or outside as if every point had been lifted to the
/// paraboloid x^2 + y^2 + z^2 and then raised by an infinitely small height, by far the most the lexicographically
/// largest point (Devillers and Teillaud 2011, devillers2011). Coordinates do not move, so cells never become flat; and
/// since the points alone decide about each sphere, they alone decide about the triangulation. e must differ from the
/// others. Takes about 15 ns; near a tie half a microsecond if the coordinates have few bits (see predicates.cpp), else
/// some microseconds.
inline bool in_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    const VectorPair ac = VectorPair(a, c) - VectorPair(e, e), bd = VectorPair(b, d) - VectorPair(e, e);
    const Pair lift_ac = ac.squared_norm(), lift_bd = bd.squared_norm();
    const double det = detail::lifted_determinant(ac, bd, lift_ac, lift_bd);
    // Every difference is at most the root of the largest lift.
    const double largest_lift = largest_of(largest(lift_ac, lift_bd));
    constexpr double roundings = 20, terms = 24;
    const double error = roundings * terms * 0x1p-53 * (largest_lift * largest_lift * std::sqrt(largest_lift));
    // No product underflows or overflows where it would matter.
    const bool is_safe = largest_lift > 1e-100 && largest_lift < 1e100;
    if (std::abs(det) > error && is_safe) return det > 0;
    return detail::in_sphere_near_tie(a, b, c, d, e);
}

/// Whether the three points lie on one line. Exact, slow.
bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Compares x first, then y, then z.
inline bool lexicographically_less(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace kerf
