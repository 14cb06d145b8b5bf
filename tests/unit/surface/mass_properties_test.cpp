#include "surface/complex/mass_properties.h"

#include <algorithm>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/shapes.h"
#include "surface/arrange/winding_number.h"
#include "surface/complex/point_inside.h"

namespace kerf {
namespace {

MassProperties properties(const Soup& soup) { return mass_properties(test::to_surface(soup)); }

Soup rotated(Soup soup, const Eigen::Matrix3d& rotation) {
    for (Vec3& p : soup.vertices) p = rotation * p;
    return soup;
}

void expect_axes(const MassProperties& mass, const Eigen::Matrix3d& axes, double tolerance) {
    EXPECT_LE((mass.axes - axes).cwiseAbs().maxCoeff(), tolerance) << mass.axes;
}

TEST(MassProperties, OfABox) {
    const MassProperties mass = properties(test::box(Vec3(1, 2, 3), Vec3(7, 4, 6), {6, 2, 3}));
    EXPECT_NEAR(mass.volume, 36, 1e-12);
    EXPECT_NEAR(mass.area, 2 * (12 + 6 + 18), 1e-12);
    EXPECT_LE((mass.centroid - Vec3(4, 3, 4.5)).norm(), 1e-13);
    expect_axes(mass, (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, 1, 0).finished(), 0);  // x is longest, then z
    EXPECT_LT(mass.eigenvalues[0], mass.eigenvalues[1]);
    EXPECT_LT(mass.eigenvalues[1], mass.eigenvalues[2]);
}

TEST(MassProperties, InertiaIsThatOfTheVertices) {
    const Soup soup = test::torus(3, 1, 11, 7);
    const MassProperties mass = properties(soup);
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (const Vec3& p : soup.vertices) {
        const Vec3 r = p - mass.centroid;
        inertia += r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
    }
    EXPECT_LE((mass.inertia - inertia).cwiseAbs().maxCoeff(), 1e-10 * inertia.norm());
}

TEST(MassProperties, OfShellsAndVoids) {
    EXPECT_NEAR(properties(test::nested_boxes(2, 2)).volume, 26, 1e-12);
    EXPECT_NEAR(properties(test::nested_boxes(3, 2)).volume, 125 - 26, 1e-11);
    EXPECT_LT(properties(test::inside_out(test::box())).volume, 0);
    const MassProperties sphere = properties(test::icosphere(5, 2));
    EXPECT_NEAR(sphere.volume, 32 * std::numbers::pi / 3, 0.05);
    EXPECT_NEAR(sphere.area, 16 * std::numbers::pi, 0.05);
}

TEST(MassProperties, VolumeDoesNotSufferFarFromTheOrigin) {
    const Soup soup = test::icosphere(3);
    EXPECT_NEAR(properties(test::translated(soup, Vec3(1e6, -1e6, 1e6))).volume / properties(soup).volume, 1, 1e-9);
}

// Boxes of whole numbers, far away and scaled by powers of two, have a volume without rounding; turned ones have that
// of the cells that their corners make, to more digits than the bound.
TEST(BoundedVolume, HoldsTheExactVolume) {
    for (const double far : {0.0, 1e3, 1e9}) {
        const Soup soup = test::translated(test::box(Vec3(0, 0, 0), Vec3(7, 5, 3), {7, 5, 3}), Vec3(far, -far, far));
        const BoundedVolume volume = bounded_volume(soup.vertices, soup.facets);
        EXPECT_LE(std::abs(volume.value - 105), volume.error);
        EXPECT_LT(volume.error, 1e-12 * 105);
        EXPECT_EQ(volume.value, enclosed_volume(soup.vertices, soup.facets));
        const MassProperties mass = properties(soup);
        EXPECT_LE(std::abs(mass.volume - 105), mass.volume_error);
    }
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const double thickness : {1.0, 1e-4, 1e-8}) {  // the same facets in another order have another origin
        Soup soup = rotated(test::box(Vec3::Zero(), Vec3(1e3, 1e3, thickness), {12, 12, 1}), rotation);
        const BoundedVolume one = bounded_volume(soup.vertices, soup.facets);
        std::reverse(soup.facets.begin(), soup.facets.end());
        const BoundedVolume other = bounded_volume(soup.vertices, soup.facets);
        EXPECT_LE(std::abs(one.value - other.value), one.error + other.error);
        EXPECT_LT(one.error, 1e-6);  // of a surface of 2e6
    }
}

// In a sum from a vertex of another shell, cancellation leaves nothing of a volume like this.
TEST(IsOutward, OfTinyShellsFarFromTheFirstVertex) {
    std::mt19937 random(3);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (const double radius : {1e-3, 3e-6, 1e-7})
        for (int place = 0; place < 30; ++place) {
            SCOPED_TRACE(testing::Message() << "radius " << radius << ", place " << place);
            const Soup outside = test::box();
            const Soup shell = test::icosphere(2, radius, Vec3(uniform(), uniform(), uniform()));
            const auto facets_of_shell = [&](const Soup& soup) {
                return std::vector<Triangle>(soup.facets.begin() + static_cast<std::ptrdiff_t>(outside.facets.size()),
                                             soup.facets.end());
            };
            const Soup solid = test::join(outside, shell), hollow = test::join(outside, test::inside_out(shell));
            EXPECT_TRUE(is_outward(solid.vertices, facets_of_shell(solid)));
            EXPECT_FALSE(is_outward(hollow.vertices, facets_of_shell(hollow)));
            EXPECT_TRUE(is_outward(hollow.vertices, outside.facets));
        }
}

TEST(MassProperties, AxesFollowARotation) {
    const Soup soup = test::box(Vec3(-3, -1, -2), Vec3(3, 1, 2), {6, 2, 4});
    const MassProperties still = properties(soup);
    for (const double angle : {0.2, 0.9, 2.5}) {
        SCOPED_TRACE(angle);
        const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
        const MassProperties mass = properties(rotated(soup, rotation));
        EXPECT_LE((mass.eigenvalues - still.eigenvalues).norm(), 1e-9 * still.eigenvalues.norm());
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(std::abs(mass.axes.col(i).dot(rotation * still.axes.col(i))), 1, 1e-12);
            Eigen::Index largest = 0;
            mass.axes.col(i).cwiseAbs().maxCoeff(&largest);
            EXPECT_GT(mass.axes(largest, i), 0);
        }
    }
}

TEST(MassProperties, SymmetricBodiesGetCoordinateAxes) {
    expect_axes(properties(test::box(Vec3::Zero(), Vec3::Ones(), 4)), Eigen::Matrix3d::Identity(), 0);
    expect_axes(properties(test::icosphere(3)), Eigen::Matrix3d::Identity(), 0);
    expect_axes(properties(test::icosphere(3, 1, Vec3(0.1, 0.7, 1e3))), Eigen::Matrix3d::Identity(), 0);
    // A bar with a square section: its length is axis 0, the other two are tied.
    const MassProperties bar = properties(test::box(Vec3::Zero(), Vec3(1, 1, 5), {2, 2, 10}));
    expect_axes(bar, (Eigen::Matrix3d() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished(), 0);
}

TEST(MassProperties, RoundingOfSymmetricBodiesDoesNotTurnTheAxes) {
    Soup soup = test::box(Vec3::Zero(), Vec3::Ones(), 4);
    for (std::size_t i = 0; i < soup.vertices.size(); i += 3) soup.vertices[i].x() += 1e-12;
    expect_axes(properties(soup), Eigen::Matrix3d::Identity(), 0);
}

TEST(PointInside, IsInsideOfAnyBody) {
    for (const Soup& soup : {test::box(), test::icosphere(2), test::torus(3, 1, 24, 12), test::nested_boxes(2),
                             test::plate_with_hole(8), test::tetrahedron()}) {
        const Vec3 point = point_inside(soup.vertices, soup.facets);
        EXPECT_GT(WindingNumber(soup.vertices, soup.facets).at(point), 0.9) << point.transpose();
    }
}

}  // namespace
}  // namespace kerf
