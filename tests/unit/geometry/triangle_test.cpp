#include "base/geometry/triangle.h"

#include <random>

#include <gtest/gtest.h>

#include "base/geometry/angles.h"
#include "base/geometry/box.h"
#include "base/geometry/ray.h"
#include "base/geometry/tetrahedron.h"

namespace kerf {
namespace {

Vec3 random_point(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return {x, y, z};
}

TEST(TriangleMeasures, OfARightTriangle) {
    const std::vector<Vec3> p = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 5}};
    EXPECT_EQ(doubled_area_vector(p, {0, 1, 2}), Vec3(0, 0, 12));
    EXPECT_EQ(area_vector(p[0], p[1], p[2]), Vec3(0, 0, 6));
    EXPECT_EQ(triangle_area(std::array{p[0], p[2], p[1]}), 6);
    EXPECT_EQ(six_volumes_of(p, {0, 1, 2, 3}), 60);
    EXPECT_NEAR(smallest_angle_degrees({p[0], p[1], p[2]}), std::atan2(3, 4) * 180 / std::numbers::pi, 1e-12);
    EXPECT_NEAR(angle_degrees(p[0], p[1], p[2]), 90, 1e-12);
    EXPECT_NEAR(dihedral_degrees(p[0], p[1], p[2], p[3]), 90, 1e-12);
    EXPECT_EQ(box_around(p).max(), Vec3(4, 3, 5));
    EXPECT_EQ(boxes_around(p, std::vector<Triangle>{{0, 1, 2}})[0].sizes(), Vec3(4, 3, 0));
}

TEST(TriangleMeasures, BothAnglesAreTheSameAwayFromNothing) {
    std::mt19937 random(5);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 apex = random_point(random), a = random_point(random), b = random_point(random);
        EXPECT_NEAR(angle_between(a - apex, b - apex) * 180 / std::numbers::pi, angle_degrees(apex, a, b), 1e-5);
        EXPECT_EQ(angle_between(a, b), angle_between(b, a));
        const double six = six_volumes_of(apex, a, b, Vec3::Zero());
        EXPECT_NEAR(six_volumes_of(a, apex, b, Vec3::Zero()), -six, 1e-14);
    }
}

TEST(Ray, MeetsATriangleThatItIsAimedAtAndTheBoxAroundIt) {
    std::mt19937 random(6);
    for (int i = 0; i < 1000; ++i) {
        const std::array<Vec3, 3> t = {random_point(random), random_point(random), random_point(random)};
        if (triangle_area(t) < 0.01) continue;
        const Vec3 target = (t[0] + t[1] + 2 * t[2]) / 4, origin = random_point(random), direction = target - origin;
        if (std::abs(doubled_area_vector(t).normalized().dot(direction)) < 0.01) continue;
        EXPECT_NEAR(line_triangle_distance(origin, direction, t[0], t[1], t[2]), 1, 1e-9);
        EXPECT_NEAR(line_triangle_distance(origin, -direction, t[0], t[1], t[2]), -1, 1e-9);
        EXPECT_TRUE(std::isinf(
            line_triangle_distance(t[0] + (t[0] - target), direction.cross(t[0] - target), t[0], t[1], t[2])));
        const RayPiece piece = piece_in_box(box_around(t), origin, direction, {});
        EXPECT_LE(piece.from, 1 + 1e-9);
        EXPECT_GE(piece.to, 1 - 1e-9);
        const RayPiece behind = piece_in_box(box_around(t), origin, direction, {piece.to + 1, 100});
        EXPECT_GT(behind.from, behind.to);
    }
}

}  // namespace
}  // namespace kerf
