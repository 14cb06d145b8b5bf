// The exact half of the predicates, for the signs that the filters of predicates.h leave open. Coordinates that have
// few bits between their highest and their lowest one are integers, in a unit that fits, and are computed with integers
// of fixed width (wide_integer.h); so are those of most points in regular position, among which ties are frequent.
// CGAL's predicates serve the others: they try interval arithmetic before they go to numbers of any length. Ties of
// in_sphere() are broken by symbolic perturbation (Devillers and Teillaud 2011, devillers2011).
#include "base/geometry/predicates.h"

#include <bit>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "base/geometry/inside/wide_integer.h"

namespace kerf {

namespace {

using ExactPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

ExactPoint exact(const Vec3& p) { return {p[0], p[1], p[2]}; }

// The bits of a normal double: it is mantissa * 2^exponent.
struct Bits {
    std::int64_t mantissa;
    int exponent;
};

Bits bits_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    constexpr int mantissa_bits = 52, bias = 1075;
    const std::int64_t mantissa = (bits & ((1ULL << mantissa_bits) - 1)) | 1ULL << mantissa_bits;
    return {x < 0 ? -mantissa : mantissa, static_cast<int>(bits >> mantissa_bits & 0x7ff) - bias};
}

// The differences of the first points and the last one, in the unit of the lowest bit of any of their coordinates. Each
// is below 2^62, or there is no result.
template <std::size_t n>
using Differences = std::array<detail::Difference<WideInteger<1>>, n - 1>;

template <std::size_t n>
std::optional<Differences<n>> integer_differences(const std::array<const Vec3*, n>& points) {
    int lowest = 2000, highest = -2000;
    for (const Vec3* p : points)
        for (const double x : *p) {
            if (x == 0) continue;
            if (!std::isnormal(x)) return std::nullopt;
            const Bits bits = bits_of(x);
            lowest = std::min(lowest, bits.exponent + std::countr_zero(static_cast<std::uint64_t>(bits.mantissa)));
            highest = std::max(highest, bits.exponent + 53);
        }
    if (highest - lowest > 61) return std::nullopt;
    const auto integer = [&](double x) -> std::int64_t {
        if (x == 0) return 0;
        const Bits bits = bits_of(x);
        const int shift = bits.exponent - lowest;
        return shift < 0 ? bits.mantissa >> -shift : bits.mantissa << shift;
    };
    Differences<n> differences;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t last = integer((*points[n - 1])[axis]);
        for (std::size_t i = 0; i + 1 < n; ++i)
            differences[i][axis] = {{static_cast<std::uint64_t>(integer((*points[i])[axis]) - last)}};
    }
    return differences;
}

int exact_in_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    if (const auto from_e = integer_differences<5>({&a, &b, &c, &d, &e})) {
        const auto& [p, q, r, s] = *from_e;
        return detail::lifted_determinant(p, q, r, s).sign();
    }
    return CGAL::side_of_oriented_sphere(exact(a), exact(b), exact(c), exact(d), exact(e));
}

// With e = sum of l_i p_i over the corners, e is inside if its lift is below sum of l_i lift_i. Raising e puts it
// outside; raising p_i inside if l_i > 0, which is the sign of the cell with e in place of p_i.
bool tie_is_inside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
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

}  // namespace

int detail::exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (const auto from_d = integer_differences<4>({&a, &b, &c, &d})) {
        const auto& [p, q, r] = *from_d;
        return -detail::determinant(p, q, r).sign();
    }
    return CGAL::orientation(exact(a), exact(b), exact(c), exact(d));
}

bool detail::in_sphere_near_tie(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    const int side = exact_in_sphere(a, b, c, d, e);
    return side == 0 ? tie_is_inside(a, b, c, d, e) : side > 0;
}

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
    return CGAL::collinear(exact(a), exact(b), exact(c));
}

}  // namespace kerf
