#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "fill/volume/mesher.h"
#include "support/shapes.h"

namespace kerf {
namespace {

std::vector<Vec3> hole_points_of(const Soup& soup) { return hole_points(test::to_arrays(soup)); }

// Distance from the centre in the norm whose balls are cubes.
double cube_radius(const Vec3& p) { return p.cwiseAbs().maxCoeff(); }

TEST(HolePoints, NoneWithoutVoids) {
    EXPECT_TRUE(hole_points_of(test::box()).empty());
    EXPECT_TRUE(hole_points_of(test::torus(2, 0.5, 24, 12)).empty());
    EXPECT_TRUE(hole_points_of(test::join(test::box(), test::translated(test::box(), Vec3(5, 0, 0)))).empty());
}

TEST(HolePoints, OneBetweenEveryPairOfNestedBoxes) {
    for (int boxes = 1; boxes <= 7; ++boxes)
        for (const int n : {1, 3}) {
            SCOPED_TRACE(testing::Message() << boxes << " boxes, " << n << " divisions");
            const std::vector<Vec3> points = hole_points_of(test::nested_boxes(boxes, n));
            ASSERT_EQ(points.size(), static_cast<std::size_t>(boxes / 2));
            for (std::size_t i = 0; i < points.size(); ++i) {
                // Void shells come smallest first; the radius of box number b is 0.5 + b.
                const double outer = 0.5 + double(2 * i) + (boxes % 2 ? 1 : 0);
                EXPECT_LT(cube_radius(points[i]), outer);
                EXPECT_GT(cube_radius(points[i]), outer - 1);
            }
        }
}

TEST(HolePoints, LieInManyRandomVoids) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const auto uniform = [&] { return double(random()) / 4294967296.0; };
        Soup soup = test::box(Vec3::Zero(), Vec3::Constant(4), 2);
        std::vector<Vec3> centres;
        std::vector<double> radii;
        for (int x = 0; x < 3; ++x)
            for (int y = 0; y < 3; ++y) {
                centres.push_back(Vec3(x + 0.8 + 0.2 * uniform(), y + 0.8 + 0.2 * uniform(), 1 + 2 * uniform()));
                radii.push_back(1e-4 + 0.3 * uniform());
                soup = test::join(soup, test::inside_out(test::icosphere(1, radii.back(), centres.back())));
            }
        const std::vector<Vec3> points = hole_points_of(soup);
        ASSERT_EQ(points.size(), centres.size());
        for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((points[i] - centres[i]).norm(), radii[i]);
    }
}

TEST(HolePoints, LieInTinyVoids) {
    std::mt19937 random(3);
    const auto uniform = [&] { return 0.1 + 0.8 * double(random()) / 4294967296.0; };
    for (int place = 0; place < 30; ++place) {
        SCOPED_TRACE(place);
        const Vec3 centre(uniform(), uniform(), uniform());
        const Soup void_shell = test::inside_out(test::icosphere(2, 3e-6, centre));
        const std::vector<Vec3> points = hole_points_of(test::join(test::box(), void_shell));
        ASSERT_EQ(points.size(), 1u);
        EXPECT_LT((points[0] - centre).norm(), 3e-6);
    }
}

TEST(HolePoints, DoNotDependOnPlaceAndScale) {
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double offset : {0.0, 1e5}) {
            SCOPED_TRACE(testing::Message() << "scale " << scale << ", offset " << offset);
            Soup soup = test::translated(test::nested_boxes(2, 2), Vec3(offset, -offset, 2 * offset));
            for (Vec3& p : soup.vertices) p *= scale;
            const std::vector<Vec3> points = hole_points_of(soup);
            ASSERT_EQ(points.size(), 1u);
            EXPECT_LT(cube_radius(points[0] / scale - Vec3(offset, -offset, 2 * offset)), 0.5);
        }
}

TEST(HolePoints, FindThinVoids) {
    for (const double thickness : {1e-3, 1e-6, 1e-9}) {
        SCOPED_TRACE(thickness);
        const Soup slit = test::box(Vec3(1, 1, 2), Vec3(3, 3, 2 + thickness), 3);
        const std::vector<Vec3> points =
            hole_points_of(test::join(test::box(Vec3::Zero(), Vec3::Constant(4), 1), test::inside_out(slit)));
        ASSERT_EQ(points.size(), 1u);
        EXPECT_GT(points[0].z(), 2);
        EXPECT_LT(points[0].z(), 2 + thickness);
    }
}

TEST(HolePoints, RefuseAVoidOutsideOfTheMaterial) {
    const Soup beside = test::translated(test::inside_out(test::box()), Vec3(5, 0, 0));
    for (const Soup& soup : {test::inside_out(test::box()), test::join(test::box(), beside)}) {
        try {
            hole_points_of(soup);
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::subdomain);
        }
    }
}

}  // namespace
}  // namespace kerf
