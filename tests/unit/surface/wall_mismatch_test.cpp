// Boxes side by side, whose distance is known, turned and moved at random.
#include "surface/diagnosis/inside/wall_mismatch.h"

#include <random>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace kerf {
namespace {

struct TwoBodies {
    Soup soup;
    std::vector<std::int32_t> body;
};

// The second one is moved by `shift` before both are turned.
TwoBodies side_by_side(const Soup& left, Soup right, const Vec3& shift, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    turn.normalize();
    for (Vec3& p : right.vertices) p += shift;
    TwoBodies two{test::join(left, right), {}};
    for (Vec3& p : two.soup.vertices) p = turn * p;
    for (std::size_t f = 0; f < two.soup.facets.size(); ++f) two.body.push_back(f < left.facets.size() ? 0 : 1);
    return two;
}

Soup left_box(int n) { return test::box(Vec3(0, 0, 0), Vec3(1, 1, 1), n); }
Soup right_box(int n) { return test::box(Vec3(1, 0, 0), Vec3(2, 1, 1), n); }

std::vector<WallMismatch> gaps_of(const TwoBodies& two, double share = 1e-2) {
    return find_gaps(two.soup.vertices, two.soup.facets, two.body, share);
}
std::vector<WallMismatch> overlaps_of(const TwoBodies& two) {
    return find_overlaps(two.soup.vertices, two.soup.facets, two.body);
}

void expect_facets_of_both(const WallMismatch& mismatch, const TwoBodies& two) {
    EXPECT_EQ(mismatch.bodies, (std::array<std::int32_t, 2>{0, 1}));
    ASSERT_GE(mismatch.facets.size(), 2U);
    EXPECT_NE(two.body[mismatch.facets[0]], two.body[mismatch.facets[1]]);
}

TEST(Gaps, AreAsWideAsTheyAreWhateverTheTriangles) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const int n = 1 + static_cast<int>(seed % 4), m = 1 + static_cast<int>(seed / 4 % 4);
        const double width = std::pow(10, -3 - 6.0 * seed / 40);
        const TwoBodies two = side_by_side(left_box(n), right_box(m), Vec3(width, 0.01, 0.02), seed);
        const std::vector<WallMismatch> gaps = gaps_of(two);
        ASSERT_EQ(gaps.size(), 1U);
        EXPECT_EQ(gaps[0].kind, WallMismatch::Kind::gap);
        EXPECT_NEAR(gaps[0].distance, width, 1e-12);
        EXPECT_NEAR(gaps[0].least_share, width / (std::sqrt(2) / std::max(n, m)), 1e-9);
        expect_facets_of_both(gaps[0], two);
        EXPECT_TRUE(overlaps_of(two).empty());
    }
}

TEST(Gaps, AreNoneWhereBodiesAreApartOrTouchAtAnEdge) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const double width = 0.06 * seed;  // at least a hundredth of an edge
        EXPECT_TRUE(gaps_of(side_by_side(left_box(1), right_box(2), Vec3(width, 0, 0), seed)).empty());
        EXPECT_TRUE(gaps_of(side_by_side(left_box(2), right_box(2), Vec3(1e-6, 1, 0), seed)).empty());
    }
}

// The void of a thin box: its facets lie back to back with those around them.
TEST(Gaps, AreNoThinWalls) {
    Soup outer = left_box(2), inner = test::box(Vec3::Constant(1e-5), Vec3::Constant(1 - 1e-5), 2);
    for (Triangle& t : inner.facets) std::swap(t[1], t[2]);
    EXPECT_TRUE(gaps_of(side_by_side(outer, inner, Vec3::Zero(), 1)).empty());
    // The other way round it is a body in a void.
    for (Soup* soup : {&outer, &inner})
        for (Triangle& t : soup->facets) std::swap(t[1], t[2]);
    EXPECT_EQ(gaps_of(side_by_side(outer, inner, Vec3::Zero(), 1)).size(), 1U);
}

TEST(Overlaps, AreAsDeepAsTheyAre) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const int n = 1 + static_cast<int>(seed % 4), m = 1 + static_cast<int>(seed / 4 % 4);
        const double depth = std::pow(10, -1 - 4.0 * seed / 40);
        const TwoBodies two = side_by_side(left_box(n), right_box(m), Vec3(-depth, 0.13, 0.17), seed);
        const std::vector<WallMismatch> overlaps = overlaps_of(two);
        ASSERT_EQ(overlaps.size(), 1U);
        EXPECT_EQ(overlaps[0].kind, WallMismatch::Kind::overlap);
        EXPECT_NEAR(overlaps[0].distance, depth, 1e-9);
        expect_facets_of_both(overlaps[0], two);
    }
}

TEST(Overlaps, OfBarsThatCrossAreKnownWithoutACornerInside) {
    const Soup one = test::box(Vec3(0, 1, 0), Vec3(3, 2, 1)), other = test::box(Vec3(1, 0, 0.1), Vec3(2, 3, 0.9));
    const TwoBodies two = side_by_side(one, other, Vec3::Zero(), 3);
    const std::vector<WallMismatch> overlaps = overlaps_of(two);
    ASSERT_EQ(overlaps.size(), 1U);
    EXPECT_EQ(overlaps[0].kind, WallMismatch::Kind::overlap);
    EXPECT_GT(overlaps[0].distance, 0.05);
}

TEST(UnlikeWalls, AreToldFromOverlaps) {
    for (int n = 1; n <= 4; ++n)
        for (int m = 1; m <= 4; ++m) {
            if (n == m) continue;
            TwoBodies two{test::join(left_box(n), right_box(m)), {}};
            for (std::size_t f = 0; f < two.soup.facets.size(); ++f)
                two.body.push_back(f < left_box(n).facets.size() ? 0 : 1);
            weld_exactly(two.soup);
            const std::vector<WallMismatch> unlike = overlaps_of(two);
            ASSERT_EQ(unlike.size(), 1U) << n << " and " << m;
            EXPECT_EQ(unlike[0].kind, WallMismatch::Kind::unlike);
            EXPECT_EQ(unlike[0].distance, 0);
            EXPECT_NEAR(unlike[0].where.x(), 1, 1e-12);
            expect_facets_of_both(unlike[0], two);
        }
}

TEST(UnlikeWalls, AreNoneWhereFacetsAreTheSame) {
    for (int n = 1; n <= 4; ++n) {
        TwoBodies two{test::join(left_box(n), right_box(n)), {}};
        for (std::size_t f = 0; f < two.soup.facets.size(); ++f)
            two.body.push_back(2 * f < two.soup.facets.size() ? 0 : 1);
        weld_exactly(two.soup);
        EXPECT_TRUE(overlaps_of(two).empty());
    }
}

}  // namespace
}  // namespace kerf
