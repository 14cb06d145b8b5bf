#include "base/geometry/predicates.h"

#include <random>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include "base/geometry/inside/wide_integer.h"
#include "support/point_sets.h"

namespace kerf {
namespace {

constexpr unsigned predicate_seed = 11;

CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 point_of(const Vec3& p) { return {p[0], p[1], p[2]}; }

// Few values for coordinates, so that many points lie in planes and on spheres, some by one rounding beside them, and
// bits enough that they do not fit into integers for some.
std::vector<Vec3> points_in_special_position(std::mt19937& random, double unit, double offset, double noise) {
    std::vector<Vec3> points(5);
    const std::uint32_t values = 2 + random() % 3;
    for (Vec3& p : points)
        for (double& x : p) {
            x = offset + unit * static_cast<double>(random() % values);
            if (random() % 16 == 0) x *= 1 + noise;
        }
    return points;
}

bool are_distinct(const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (points[i] == points[j]) return false;
    return true;
}

// Calls test(points) with points in general and special position, of all sizes.
template <class Test>
void for_many_points(Test test) {
    std::mt19937 random(predicate_seed);
    for (int i = 0; i < 40000; ++i) {
        const double unit = std::array{1.0, 0.1, 1e-9, 1e30, 1e-63, 1e-107}[random() % 6];
        const double offset = unit * std::array{0.0, 1.0, 0.3, 1e3, 1e-20}[random() % 5];
        const double noise = std::array{0.0, 0x1p-52, 1e-8}[random() % 3];
        const std::vector<Vec3> points =
            i % 10 == 0 ? test::random_points(random, 5) : points_in_special_position(random, unit, offset, noise);
        if (!are_distinct(points)) continue;
        test(points[0], points[1], points[2], points[3], points[4]);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(Predicates, OrientationIsThatOfCgal) {
    std::array<int, 3> seen = {};
    for_many_points([&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3&) {
        const int sign = orientation(a, b, c, d);
        ASSERT_EQ(sign, static_cast<int>(CGAL::orientation(point_of(a), point_of(b), point_of(c), point_of(d))));
        ++seen[sign + 1];
    });
    for (const int count : seen) EXPECT_GT(count, 1000) << "seed " << predicate_seed;
}

TEST(Predicates, OrientationChangesWithTheOrderAlone) {
    for_many_points([&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3&) {
        const int sign = orientation(a, b, c, d);
        ASSERT_EQ(orientation(b, a, c, d), -sign);
        ASSERT_EQ(orientation(a, b, d, c), -sign);
        ASSERT_EQ(orientation(b, c, a, d), sign);
        ASSERT_EQ(orientation(d, c, b, a), sign);
        if (are_collinear(a, b, c)) {
            ASSERT_EQ(sign, 0);
        }
    });
}

TEST(Predicates, InSphereIsThatOfCgalWhereThereIsNoTie) {
    std::array<int, 3> seen = {};
    for_many_points([&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
        if (orientation(a, b, c, d) <= 0) return;
        const auto side =
            CGAL::side_of_oriented_sphere(point_of(a), point_of(b), point_of(c), point_of(d), point_of(e));
        ++seen[static_cast<int>(side) + 1];
        if (side == CGAL::ON_ORIENTED_BOUNDARY) return;
        ASSERT_EQ(in_sphere(a, b, c, d, e), side == CGAL::ON_POSITIVE_SIDE);
    });
    for (const int count : seen) EXPECT_GT(count, 500) << "seed " << predicate_seed;
}

// The lift of five points has one sign, whichever of them is asked whether it is inside of the sphere of the others.
TEST(Predicates, InSphereDecidesTiesAsIfThereWereNone) {
    for_many_points([&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
        if (orientation(a, b, c, d) <= 0) return;
        const bool is_inside = in_sphere(a, b, c, d, e);
        ASSERT_EQ(in_sphere(b, c, a, d, e), is_inside);
        ASSERT_EQ(in_sphere(d, c, b, a, e), is_inside);
        const int with_e = orientation(a, b, c, e);  // of the cell on the same side of the face, or on the other one
        if (with_e > 0) {
            ASSERT_NE(in_sphere(a, b, c, e, d), is_inside);
        } else if (with_e < 0) {
            ASSERT_EQ(in_sphere(b, a, c, e, d), is_inside);
        }
    });
}

template <std::size_t n>
WideInteger<n> random_integer(std::mt19937& random) {
    WideInteger<n> x;
    for (std::uint64_t& limb : x.limb) {
        const std::array<std::uint64_t, 4> values = {0, ~0ULL, std::uint64_t{random()} << 32 | random(), 1};
        limb = values[random() % 4];
    }
    // Room for one sum.
    x.limb[n - 1] = static_cast<std::uint64_t>(static_cast<std::int64_t>(x.limb[n - 1]) >> 2);
    return x;
}

TEST(WideInteger, ObeysTheLawsOfArithmetic) {
    std::mt19937 random(predicate_seed);
    for (int i = 0; i < 5000; ++i) {
        const auto a = random_integer<1>(random), b = random_integer<1>(random);
        const auto c = random_integer<2>(random), d = random_integer<2>(random);
        const auto e = random_integer<3>(random);
        EXPECT_EQ((a * b).limb, (b * a).limb);
        EXPECT_EQ((a * c).limb, (c * a).limb);
        EXPECT_EQ(((a * c) * e).limb, (a * (c * e)).limb);
        EXPECT_EQ((e * (c + d)).limb, (e * c + e * d).limb);
        EXPECT_EQ((e * (c - d)).limb, (e * c - e * d).limb);
        EXPECT_EQ((c - d).sign(), -(d - c).sign());
        EXPECT_EQ((c * e).sign(), c.sign() * e.sign());
        const auto as_int = [](const WideInteger<1>& x) { return static_cast<std::int64_t>(x.limb[0]); };
        EXPECT_EQ(a.sign(), (as_int(a) > 0) - (as_int(a) < 0));
        EXPECT_EQ((a - b).sign(), (as_int(a) > as_int(b)) - (as_int(a) < as_int(b)));
        EXPECT_EQ((a * b).limb[0], a.limb[0] * b.limb[0]);
    }
}

}  // namespace
}  // namespace kerf
