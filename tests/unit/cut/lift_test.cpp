#include "cut/cut/inside/lift.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

constexpr int contour_count = 80;

PlanarTriangulation disc() {
    PlanarRegion region;
    for (int i = 0; i < contour_count; ++i) {
        const double angle = 2 * std::numbers::pi * i / contour_count;
        region.contour.emplace_back(2 * std::cos(angle), std::sin(angle));
        region.edges.push_back({i, (i + 1) % contour_count});
    }
    return triangulate(region);
}

template <class Height>
std::vector<double> contour_heights(const PlanarTriangulation& t, Height height) {
    std::vector<double> heights;
    for (int i = 0; i < contour_count; ++i) heights.push_back(height(t.points[i]));
    return heights;
}

TEST(Lift, ReproducesPlanes) {
    const PlanarTriangulation t = disc();
    ASSERT_GT(t.points.size(), contour_count + 20u);
    for (const Vec3& plane : {Vec3(0, 0, 0), Vec3(0, 0, 7), Vec3(0.3, -1.2, 5)}) {
        const auto height = [&](const Vec2& p) { return plane.x() * p.x() + plane.y() * p.y() + plane.z(); };
        const std::vector<double> heights = lift_heights(t, t.points, contour_heights(t, height), {});
        ASSERT_EQ(heights.size(), t.points.size());
        // Weights of flat triangles are raised to keep the maximum principle, so a slope is not kept to the last digit.
        const double tolerance = plane.head<2>().isZero() ? 1e-13 : 1e-3;
        for (std::size_t v = 0; v < heights.size(); ++v) EXPECT_NEAR(heights[v], height(t.points[v]), tolerance);
    }
}

TEST(Lift, ObeysTheMaximumPrinciple) {
    const PlanarTriangulation t = disc();
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 20; ++i) {
        const std::vector<double> contour = contour_heights(t, [&](const Vec2&) { return uniform(random); });
        const std::vector<double> heights = lift_heights(t, t.points, contour, {});
        EXPECT_TRUE(std::equal(contour.begin(), contour.end(), heights.begin())) << "the contour stays";
        const auto [low, high] = std::minmax_element(contour.begin(), contour.end());
        for (const double z : heights) {
            EXPECT_GE(z, *low);
            EXPECT_LE(z, *high);
        }
    }
}

TEST(Lift, PassesObstaclesOnTheirSide) {
    const PlanarTriangulation t = disc();
    const std::vector<double> flat(contour_count, 0);
    for (const Side side : {Side::below, Side::above}) {
        SCOPED_TRACE(static_cast<int>(side));
        const double sign = side == Side::below ? 1 : -1;
        const Obstacle tip{Vec2(0.3, 0.1), sign * 0.4, 0.2, side, 0.5};
        const std::vector<double> heights = lift_heights(t, t.points, flat, {tip});
        int raised = 0;
        for (std::size_t v = contour_count; v < heights.size(); ++v) {
            const double distance = (t.points[v] - tip.position).norm();
            if (distance > 3 * tip.size) continue;
            EXPECT_GE(sign * heights[v], 0.4 + 0.5 * 0.2 - 0.3 * distance - 1e-12);
            ++raised;
        }
        EXPECT_GT(raised, 0);
        for (int v = 0; v < contour_count; ++v) EXPECT_EQ(heights[v], 0);
    }
}

TEST(Lift, ObstaclesOutOfTheWayChangeNothing) {
    const PlanarTriangulation t = disc();
    const std::vector<double> contour = contour_heights(t, [](const Vec2& p) { return p.x() * p.y(); });
    const Obstacle deep{Vec2(0, 0), -10, 0.2, Side::below, 0.5}, beside{Vec2(50, 0), 3, 0.2, Side::below, 0.5};
    EXPECT_EQ(lift_heights(t, t.points, contour, {deep, beside}), lift_heights(t, t.points, contour, {}));
}

TEST(Lift, WithoutInteriorPointsIsTheContour) {
    PlanarTriangulation t;
    t.points = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
    t.triangles = {{0, 1, 2}};
    EXPECT_EQ(lift_heights(t, t.points, {1, 2, 3}, {}), (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace kerf
