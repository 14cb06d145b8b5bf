// CGAL's predicates try interval arithmetic before they go to numbers of any length.
#include "delaunay/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace kerf {

namespace {

using ExactPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

ExactPoint exact(const Vec3& p) { return {p[0], p[1], p[2]}; }

}  // namespace

int detail::exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return CGAL::orientation(exact(a), exact(b), exact(c), exact(d));
}

int detail::exact_in_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    return CGAL::side_of_oriented_sphere(exact(a), exact(b), exact(c), exact(d), exact(e));
}

// With e = sum of l_i p_i over the corners, e is inside if its lift is below sum of l_i lift_i. Raising e puts it
// outside; raising p_i inside if l_i > 0, which is the sign of the cell with e in place of p_i.
bool detail::tie_is_inside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    std::array<const Vec3*, 5> raised = {&a, &b, &c, &d, &e};
    std::sort(raised.begin(), raised.end(),
              [](const Vec3* p, const Vec3* q) { return lexicographically_less(*q, *p); });
    for (const Vec3* p : raised) {
        if (p == &e) return false;
        const auto corner = [&](const Vec3& v) -> const Vec3& { return &v == p ? e : v; };
        const int sign = orientation(corner(a), corner(b), corner(c), corner(d));
        if (sign != 0) return sign > 0;
    }
    return false;
}

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
    return CGAL::collinear(exact(a), exact(b), exact(c));
}

}  // namespace kerf
