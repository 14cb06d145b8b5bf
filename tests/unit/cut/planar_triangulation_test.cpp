#include "cut/cut/planar_triangulation.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
namespace kerf {
namespace {

double cross_2d(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Adds a closed loop; the region lies on its left.
void add_loop(PlanarRegion& region, const std::vector<Vec2>& points) {
    const auto first = static_cast<std::int32_t>(region.contour.size()), n = static_cast<std::int32_t>(points.size());
    for (std::int32_t i = 0; i < n; ++i) region.edges.push_back({first + i, first + (i + 1) % n});
    region.contour.insert(region.contour.end(), points.begin(), points.end());
}

std::vector<Vec2> circle(int n, double radius, const Vec2& centre = Vec2::Zero()) {
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

std::vector<Vec2> reversed(std::vector<Vec2> points) {
    std::reverse(points.begin(), points.end());
    return points;
}

PlanarRegion disc(int n, double radius) {
    PlanarRegion region;
    add_loop(region, circle(n, radius));
    return region;
}

double region_area(const PlanarRegion& region) {
    double area = 0;
    for (const auto& [a, b] : region.edges) area += cross_2d(region.contour[a], region.contour[b]) / 2;
    return area;
}

// Contour points are kept bit for bit, every triangle is counter-clockwise, contour edges have the region on their left
// and nothing on their right, all other edges have two triangles, and the areas add up.
void expect_conforming(const PlanarRegion& region, const PlanarTriangulation& t) {
    ASSERT_EQ(t.refusal, Refusal::none);
    EXPECT_TRUE(t.failed.empty());
    ASSERT_GE(t.points.size(), region.contour.size());
    EXPECT_TRUE(std::equal(region.contour.begin(), region.contour.end(), t.points.begin()));
    std::map<std::array<std::int32_t, 2>, int> directed;
    double area = 0;
    for (const Triangle& c : t.triangles) {
        const double twice = cross_2d(t.points[c[1]] - t.points[c[0]], t.points[c[2]] - t.points[c[0]]);
        EXPECT_GT(twice, 0);
        area += twice / 2;
        for (int i = 0; i < 3; ++i) ++directed[{c[i], c[(i + 1) % 3]}];
    }
    EXPECT_NEAR(area, region_area(region), 1e-12 * area);
    std::vector<std::array<std::int32_t, 2>> outer, wanted = region.edges;
    for (const auto& [edge, count] : directed) {
        EXPECT_EQ(count, 1);
        if (!directed.contains({edge[1], edge[0]})) outer.push_back(edge);
    }
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(outer, wanted);
}

TEST(PlanarTriangulation, OfADisc) {
    for (const int n : {3, 4, 7, 40, 500}) {
        SCOPED_TRACE(n);
        const PlanarRegion region = disc(n, 1);
        expect_conforming(region, triangulate(region));
    }
}

TEST(PlanarTriangulation, OfNestedLoops) {
    PlanarRegion region = disc(60, 4);
    add_loop(region, reversed(circle(40, 3)));
    add_loop(region, circle(30, 2));
    add_loop(region, reversed(circle(12, 0.5, Vec2(0.7, 0.7))));
    add_loop(region, reversed(circle(10, 0.5, Vec2(-0.7, 0))));
    add_loop(region, circle(20, 1, Vec2(9, 1)));
    expect_conforming(region, triangulate(region));
}

TEST(PlanarTriangulation, OfRandomStars) {
    constexpr unsigned seed = 3;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> radius(0.4, 1);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", star " << i);
        PlanarRegion region = disc(5 + i, 1);
        for (Vec2& p : region.contour) p *= radius(random);
        expect_conforming(region, triangulate(region));
    }
}

TEST(PlanarTriangulation, OfContoursOnALattice) {
    // Collinear and cocircular points: a comb with five teeth of lattice cells.
    std::vector<Vec2> comb;
    for (int x = 0; x <= 9; ++x) comb.emplace_back(x, 0);
    for (int x = 9; x > 0; x -= 2) comb.insert(comb.end(), {Vec2(x, 1), Vec2(x, 2), Vec2(x - 1, 2), Vec2(x - 1, 1)});
    PlanarRegion region;
    add_loop(region, comb);
    expect_conforming(region, triangulate(region));
}

TEST(PlanarTriangulation, AnglesAreGoodInsideOfEvenContours) {
    const PlanarRegion region = disc(100, 1);
    const PlanarTriangulation t = triangulate(region);
    double smallest = 180;
    for (const Triangle& c : t.triangles)
        for (int i = 0; i < 3; ++i) {
            const Vec2 a = t.points[c[(i + 1) % 3]] - t.points[c[i]], b = t.points[c[(i + 2) % 3]] - t.points[c[i]];
            smallest = std::min(smallest, std::atan2(cross_2d(a, b), a.dot(b)) * 180 / std::numbers::pi);
        }
    EXPECT_GT(smallest, 25);
}

TEST(PlanarTriangulation, SizesGrowInwardsUpToTheBound) {
    PlanarRegion region = disc(400, 1);
    const std::size_t graded = triangulate(region).triangles.size();
    constexpr double bound = 0.02;
    region.max_edge = [](const Vec2&) { return bound; };
    const PlanarTriangulation bounded = triangulate(region);
    expect_conforming(region, bounded);
    EXPECT_GT(bounded.triangles.size(), 3 * graded);
    double longest = 0;
    for (const Triangle& c : bounded.triangles)
        for (int i = 0; i < 3; ++i)
            longest = std::max(longest, (bounded.points[c[i]] - bounded.points[c[(i + 1) % 3]]).norm());
    EXPECT_LT(longest, 2 * bound);
}

TEST(PlanarTriangulation, WantedPointsBecomeVerticesWhereTheyFit) {
    PlanarRegion region = disc(30, 1);
    region.wanted = {{Vec2(0.1, 0.2), 0.2}, {Vec2(-0.4, 0.3), 0.2}, {Vec2(5, 5), 0.2}};
    const PlanarTriangulation t = triangulate(region);
    expect_conforming(region, t);
    for (int i = 0; i < 2; ++i) {
        const auto nearest = std::min_element(t.points.begin(), t.points.end(), [&](const Vec2& a, const Vec2& b) {
            return (a - region.wanted[i].position).norm() < (b - region.wanted[i].position).norm();
        });
        EXPECT_LT((*nearest - region.wanted[i].position).norm(), 0.15) << "smoothing may move it a little";
    }
}

TEST(PlanarTriangulation, CrossingContoursAreRefusedWithTheirVertices) {
    PlanarRegion bow;
    add_loop(bow, {Vec2(0, 0), Vec2(2, 2), Vec2(2, 0), Vec2(0, 2)});
    const PlanarTriangulation t = triangulate(bow);
    EXPECT_EQ(t.refusal, Refusal::crossing_projection);
    EXPECT_EQ(t.failed, (std::vector<std::int32_t>{0, 1, 2, 3}));
    EXPECT_TRUE(t.triangles.empty());

    PlanarRegion two = disc(4, 1);  // its edge 0-1 passes through (0.5, 0.5)
    add_loop(two, {Vec2(0.4, 0.4), Vec2(3, 0.4), Vec2(3, 3)});
    EXPECT_EQ(triangulate(two).refusal, Refusal::crossing_projection);
    EXPECT_EQ(triangulate(two).failed, (std::vector<std::int32_t>{0, 1, 4, 5, 6}));
}

TEST(PlanarTriangulation, TouchingContoursAreRefused) {
    PlanarRegion corner_on_edge;
    add_loop(corner_on_edge, {Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(0, 2)});
    add_loop(corner_on_edge, {Vec2(1, 2), Vec2(2, 4), Vec2(0, 4)});
    EXPECT_EQ(triangulate(corner_on_edge).refusal, Refusal::crossing_projection);

    PlanarRegion same_point;
    add_loop(same_point, {Vec2(0, 0), Vec2(2, 0), Vec2(2, 2)});
    add_loop(same_point, {Vec2(2, 2), Vec2(4, 2), Vec2(4, 4)});
    EXPECT_NE(triangulate(same_point).refusal, Refusal::none);
}

TEST(PlanarTriangulation, WrongNestingIsRefusedWithTheWrongLoop) {
    PlanarRegion outside_in;
    add_loop(outside_in, reversed(circle(8, 1)));
    EXPECT_EQ(triangulate(outside_in).refusal, Refusal::nesting);

    PlanarRegion hole_turned = disc(20, 3);
    add_loop(hole_turned, circle(8, 1));
    const PlanarTriangulation t = triangulate(hole_turned);
    EXPECT_EQ(t.refusal, Refusal::nesting);
    ASSERT_FALSE(t.failed.empty());
    EXPECT_GE(*std::min_element(t.failed.begin(), t.failed.end()), 20);
}

TEST(PlanarTriangulation, IsDeterministic) {
    const PlanarRegion region = disc(321, 1);
    const PlanarTriangulation a = triangulate(region), b = triangulate(region);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_TRUE(a.points == b.points);
}

TEST(PlanarTriangulation, EndsAtItsLimitAndWhenItIsAskedTo) {
    PlanarRegion region = disc(400, 1);
    region.max_edge = [](const Vec2&) { return 0.01; };
    const auto points = static_cast<std::int64_t>(triangulate(region).points.size());
    EXPECT_GT(points, 10'000);
    region.max_points = points - 1;
    EXPECT_THROW(triangulate(region), Error);
    region.max_points = points + 1;
    int polls = 0;
    region.check_cancelled = CancellationCheck([&] {
        if (++polls == 5) throw Error(ErrorCode::cancelled, "enough");
    });
    EXPECT_THROW(triangulate(region), Error);
    EXPECT_EQ(polls, 5);
}

}  // namespace
}  // namespace kerf
