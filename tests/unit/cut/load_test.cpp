#include "cut/cut/inside/load.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace kerf {
namespace {

LoadProfile profile(const Surface& surface, const Plane& plane, Balance balance, double max_volume = 0) {
    return LoadProfile(surface, plane, {balance, SizeField(max_volume)});
}

constexpr std::array all_balances = {Balance::nodes, Balance::faces, Balance::volume, Balance::inertia, Balance::work};

TEST(LoadModel, WorkCountsFacetsAndWantedTetrahedra) {
    EXPECT_EQ((LoadModel{Balance::nodes, SizeField(0.1)}.load(10, 20, 3)), 10);
    EXPECT_EQ((LoadModel{Balance::faces, SizeField(0.1)}.load(10, 20, 3)), 20);
    EXPECT_EQ((LoadModel{Balance::volume, SizeField(0.1)}.load(10, 20, 3)), 3);
    EXPECT_EQ((LoadModel{Balance::work, SizeField(0)}.load(10, 20, 3)), 20);
    EXPECT_DOUBLE_EQ((LoadModel{Balance::work, SizeField(0.5)}.load(10, 20, 3)), 20 + 0.1 * 3 / 0.5);
}

TEST(LoadProfile, VolumeOfACubeAlongItsEdge) {
    const Surface cube = test::to_surface(test::box(Vec3::Zero(), Vec3::Ones(), 3));
    const LoadProfile load = profile(cube, Plane(Vec3::Zero(), Vec3::UnitZ()), Balance::volume);
    EXPECT_EQ(load.lowest(), 0);
    EXPECT_EQ(load.highest(), 1);
    for (const double z : {0.0, 0.1, 1 / 3.0, 0.5, 2 / 3.0, 0.77, 1.0}) EXPECT_NEAR(load.fraction_below(z), z, 1e-14);
    for (const double fraction : {0.1, 0.25, 1 / 3.0, 0.5, 0.9}) EXPECT_NEAR(load.bisect(fraction), fraction, 1e-8);
}

TEST(LoadProfile, VolumeOfACubeAlongItsDiagonal) {
    const Surface cube = test::to_surface(test::box(Vec3::Zero(), Vec3::Ones(), 4));
    const LoadProfile load = profile(cube, Plane(Vec3::Zero(), Vec3::Ones().normalized()), Balance::volume);
    for (double s = 0.05; s < 3; s += 0.07) {  // volume with x + y + z below s
        double volume = s * s * s;
        if (s > 1) volume -= 3 * std::pow(s - 1, 3);
        if (s > 2) volume += 3 * std::pow(s - 2, 3);
        EXPECT_NEAR(load.fraction_below(s / std::sqrt(3.0)), volume / 6, 1e-13) << s;
    }
}

TEST(LoadProfile, VolumeOfASphereIsThatOfItsCaps) {
    const Surface sphere = test::to_surface(test::icosphere(4, 2, Vec3(5, -7, 11)));
    const Vec3 normal = Vec3(1, 2, -3).normalized();
    const LoadProfile load = profile(sphere, Plane(Vec3(5, -7, 11), normal), Balance::volume);
    for (const double height : {-1.5, -0.6, 0.0, 0.3, 1.2}) {
        const double depth = height + 2;
        const double cap = std::numbers::pi * depth * depth * (6 - depth) / 3;
        EXPECT_NEAR(load.fraction_below(height), cap / (32 * std::numbers::pi / 3), 5e-4);
    }
}

TEST(LoadProfile, SecondMomentOfACubeAlongItsEdge) {
    const Surface cube = test::to_surface(test::box(Vec3::Zero(), Vec3::Ones(), 3));
    for (const double origin : {0.0, 0.5, -2.0}) {
        const LoadProfile load = profile(cube, Plane(Vec3(0, 0, origin), Vec3::UnitZ()), Balance::inertia);
        const auto moment = [&](double z) { return (std::pow(z - origin, 3) + std::pow(origin, 3)) / 3; };
        for (const double z : {0.0, 0.1, 1 / 3.0, 0.5, 0.77, 1.0})
            EXPECT_NEAR(load.fraction_below(z - origin), moment(z) / moment(1), 1e-12);
    }
}

TEST(LoadProfile, SecondMomentOfACubeAlongItsDiagonal) {
    // Of the cube's corner at x + y + z < s below 1: the integral of (u/sqrt3)^2 (u^2/2) du with u = x + y + z.
    const Surface cube = test::to_surface(test::box(Vec3::Zero(), Vec3::Ones(), 4));
    const LoadProfile load = profile(cube, Plane(Vec3::Zero(), Vec3::Ones().normalized()), Balance::inertia);
    const double whole = (3 * (1 / 3.0) + 6 * (1 / 4.0)) / 3;  // of (x + y + z)^2 / 3
    for (double s = 0.05; s < 1; s += 0.07)
        EXPECT_NEAR(load.fraction_below(s / std::sqrt(3.0)), std::pow(s, 5) / 30 / whole, 1e-13) << s;
}

TEST(LoadProfile, VoidsAreNoVolume) {
    // Edge 3 around a void of edge 1: through the middle, the section is 9 - 1.
    const Surface body = test::to_surface(test::nested_boxes(2, 3));
    const LoadProfile load = profile(body, Plane(Vec3::Zero(), Vec3::UnitX()), Balance::volume);
    EXPECT_NEAR(load.fraction_below(-0.5), 9 / 26.0, 1e-13);
    EXPECT_NEAR(load.fraction_below(0.25), (9 + 0.75 * 8) / 26.0, 1e-13);
}

TEST(LoadProfile, GrowsFromNothingToAll) {
    const Surface torus = test::to_surface(test::torus(3, 1, 24, 12));
    const Plane plane(Vec3(0.1, 0.2, 0.3), Vec3(3, 1, 2).normalized());
    for (const Balance balance : all_balances) {
        SCOPED_TRACE(static_cast<int>(balance));
        const LoadProfile load = profile(torus, plane, balance, 0.01);
        EXPECT_NEAR(load.fraction_below(load.lowest() - 1), 0, 1e-13);
        EXPECT_NEAR(load.fraction_below(load.highest() + 1), 1, 1e-13);
        double last = 0;
        for (double z = load.lowest(); z <= load.highest(); z += 0.05) {
            EXPECT_GE(load.fraction_below(z), last - 1e-13);
            last = load.fraction_below(z);
        }
    }
}

TEST(LoadProfile, BothSidesAddUp) {
    const Surface torus = test::to_surface(test::torus(3, 1, 25, 13));
    const Vec3 normal = Vec3(3, 1, 2).normalized();
    for (const Balance balance : all_balances) {
        const LoadProfile up = profile(torus, Plane(Vec3::Zero(), normal), balance, 0.01);
        const LoadProfile down = profile(torus, Plane(Vec3::Zero(), -normal), balance, 0.01);
        for (const double z : {-2.1234, -0.5678, 0.1357, 1.9753})
            EXPECT_NEAR(up.fraction_below(z) + down.fraction_below(-z), 1, 1e-12);
    }
}

TEST(LoadProfile, BisectIsTheInverse) {
    const Surface torus = test::to_surface(test::torus(3, 1, 60, 30));
    const Plane plane(Vec3(50, 0, 0), Vec3(3, 1, 2).normalized());
    for (const Balance balance : all_balances) {
        SCOPED_TRACE(static_cast<int>(balance));
        const LoadProfile load = profile(torus, plane, balance, 0.01);
        for (const double fraction : {0.2, 1 / 3.0, 0.5, 0.75}) {
            const bool continuous = balance == Balance::volume || balance == Balance::inertia;
            const double grain = continuous ? 1e-7 : 0.002;  // of one facet or vertex, and of rounding
            EXPECT_NEAR(load.fraction_below(load.bisect(fraction)), fraction, grain);
        }
    }
}

TEST(LoadProfile, ManyHeightsAtOnceAreThoseOneByOne) {
    const Surface torus = test::to_surface(test::torus(3, 1, 40, 20));
    const Surface cube =
        test::to_surface(test::box(Vec3::Zero(), Vec3::Ones(), 4));  // vertices at the heights themselves
    for (const Balance balance : all_balances)
        for (const Surface* surface : {&torus, &cube})
            for (const std::vector<double>& heights :
                 {std::vector<double>{}, {0.25}, {0.5, 0.75, 0.25}, {0.1, 0.9, 0.4, 0.3}, {-99, 99, 0}}) {
                SCOPED_TRACE(testing::PrintToString(static_cast<int>(balance)) + testing::PrintToString(heights));
                const LoadProfile load = profile(*surface, Plane(Vec3::Zero(), Vec3::UnitX()), balance, 0.01);
                const std::vector<double> fractions = load.fractions_below(heights);
                ASSERT_EQ(fractions.size(), heights.size());
                for (std::size_t i = 0; i < heights.size(); ++i)
                    EXPECT_NEAR(fractions[i], load.fraction_below(heights[i]), 1e-13);
            }
}

// Ten times as fine beyond x = 8 of a bar of length 10: nearly all work lies there.
TEST(LoadProfile, FollowsASizeThatDiffersByPlace) {
    const Surface bar = test::to_surface(test::box(Vec3::Zero(), Vec3(10, 1, 1), {40, 4, 4}));
    SizeSources sources;
    sources.growth = 0.3;
    sources.boxes.push_back({Vec3(8, 0, 0), Vec3(10, 1, 1), 0.05});
    LoadModel model{Balance::work, SizeField(0.1, sources)};
    model.volume_weight = 1;
    double integral = 0, beyond = 0;  // along the bar, across which the size is the same
    for (double x = 0.005; x < 10; x += 0.01) {
        const double wanted = 0.01 / model.size.max_volume_at(Vec3(x, 0.5, 0.5));
        integral += wanted;
        if (x > 8) beyond += wanted;
    }
    const double facets = bar.facet_count();
    EXPECT_NEAR(model.load(0, facets, model.volume_of(bar.arrays(), 10)) / (facets + integral), 1, 0.05);
    EXPECT_NEAR(model.volume_of(bar.arrays(), 10) / model.size.reference_volume() / integral, 1, 0.05);
    for (const LoadModel& asked : {model, model.of(bar)}) {
        const LoadProfile load(bar, Plane(Vec3::Zero(), Vec3::UnitX()), asked);
        EXPECT_NEAR(load.fraction_below(8), 1 - beyond / integral, 0.03);
        EXPECT_NEAR(load.bisect(0.5), 9, 0.2);
        const std::vector<double> fractions = load.fractions_below({2, 8.5, 9.5});
        EXPECT_EQ(fractions[1], load.fraction_below(8.5));
        EXPECT_TRUE(fractions[0] < fractions[1] && fractions[1] < fractions[2]);
    }
    model.balance = Balance::volume;
    EXPECT_NEAR(LoadProfile(bar, Plane(Vec3::Zero(), Vec3::UnitX()), model).bisect(0.5), 5, 1e-6);
}

TEST(LoadProfile, PlaceDoesNotMatter) {
    const Vec3 far(1e5, -2e5, 3e5);
    const Soup soup = test::icosphere(2);
    const Surface near_one = test::to_surface(soup), far_one = test::to_surface(test::translated(soup, far));
    const Vec3 normal = Vec3(1, 1, 2).normalized();
    for (const double z : {-0.7, 0.1, 0.4})
        EXPECT_NEAR(profile(near_one, Plane(Vec3::Zero(), normal), Balance::volume).fraction_below(z),
                    profile(far_one, Plane(far, normal), Balance::volume).fraction_below(z), 1e-9);
}

}  // namespace
}  // namespace kerf
