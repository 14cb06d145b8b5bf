#include "files/io/inside/polygon_fan.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace kerf {
namespace {

std::vector<std::int64_t> all_of(const std::vector<Vec3>& polygon) {
    std::vector<std::int64_t> corners(polygon.size());
    std::iota(corners.begin(), corners.end(), 0);
    return corners;
}

PolygonFan fan_of(const std::vector<Vec3>& polygon) { return find_fan(polygon, all_of(polygon)); }

Eigen::Affine3d random_motion(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    const Vec3 shift(normal(random), normal(random), normal(random));
    return Eigen::Translation3d(shift) * turn.normalized() * Eigen::Scaling(std::exp(2 * normal(random)));
}

// n corners on the unit circle at random angles.
std::vector<Vec3> inscribed(int n, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0.1, 0.9);
    std::vector<Vec3> polygon;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + uniform(random)) / n;
        polygon.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    return polygon;
}

TEST(PolygonFan, CoversConvexPolygonsWhereverTheyLie) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::vector<Vec3> polygon = inscribed(4 + static_cast<int>(random() % 20), random);
        const Eigen::Affine3d motion = random_motion(random);
        for (Vec3& p : polygon) p = (motion * p).cast<float>().cast<double>();
        const PolygonFan fan = fan_of(polygon);
        EXPECT_EQ(fan.obstacle, nullptr);
        EXPECT_EQ(fan.apex, 0u);
    }
}

TEST(PolygonFan, RefusesPolygonsOfWhichACornerIsMoved) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const int n = 4 + static_cast<int>(random() % 20);
        std::vector<Vec3> bent = inscribed(n, random);
        bent[random() % n].z() += 0.01;
        EXPECT_STREQ(fan_of(bent).obstacle, "is not planar");
        std::vector<Vec3> crossed = inscribed(n, random);
        const std::size_t i = random() % n;
        std::swap(crossed[i], crossed[(i + 1) % n]);
        EXPECT_NE(fan_of(crossed).obstacle, nullptr);
    }
}

TEST(PolygonFan, BeginsWhereCornersOnStraightSidesGiveNoDegenerateTriangles) {
    std::vector<Vec3> polygon = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(3, 2, 0), Vec3(0, 2, 0)};
    EXPECT_EQ(fan_of(polygon).apex, 1u);
    EXPECT_EQ(fan_of(polygon).obstacle, nullptr);
    polygon.insert(polygon.begin() + 1, Vec3(0.5, 0, 0));
    EXPECT_EQ(fan_of(polygon).obstacle, nullptr);
    EXPECT_EQ(fan_of(polygon).apex, 4u);
}

TEST(PolygonFan, RefusesTwoTurnsAndReflexCornersThatHideOthers) {
    std::mt19937 random(1);
    for (const int n : {4, 5, 8}) {
        std::vector<Vec3> turn = inscribed(n, random), second = turn;
        for (Vec3& p : second) p *= 0.5;
        turn.insert(turn.end(), second.begin(), second.end());
        EXPECT_NE(fan_of(turn).obstacle, nullptr) << n;
    }
    const std::vector<Vec3> comb = {Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(5, 3, 0), Vec3(4, 3, 0),
                                    Vec3(4, 1, 0), Vec3(3, 1, 0), Vec3(3, 3, 0), Vec3(2, 3, 0),
                                    Vec3(2, 1, 0), Vec3(1, 1, 0), Vec3(1, 3, 0), Vec3(0, 3, 0)};
    EXPECT_NE(fan_of(comb).obstacle, nullptr);
}

TEST(PolygonFan, RefusesPolygonsWithoutAreaAndAcceptsThoseThatAreNotFinite) {
    EXPECT_STREQ(fan_of({4, Vec3(1, 2, 3)}).obstacle, "has no area");
    EXPECT_EQ(fan_of({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, std::nan(""), 0), Vec3(0, 1, 0)}).obstacle, nullptr);
    EXPECT_NE(fan_of({Vec3(-1e308, 0, 0), Vec3(1e308, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 0)}).obstacle, nullptr);
}

}  // namespace
}  // namespace kerf
