// Two bodies with unlike facets become regions with a common wall.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/geometry/triangle.h"
#include "support/repair_steps.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {
namespace {

// A body each, called "one" and "two".
Soup two_bodies(const Soup& one, const Soup& two) {
    Soup soup = test::join(one, two);
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f >= one.facets.size();
    soup.patch_names = {"one", "two"};
    return soup;
}

StepReport snap(Soup& soup, double tolerance) {
    StepRequest request;
    request.amount = tolerance;
    request.bound = 4 * tolerance;
    return test::apply(RepairKind::snap, soup, request);
}

void make_snap_regions(Soup& soup) {
    StepRequest request;
    request.bodies = BodyRepair::regions;
    test::apply(RepairKind::intersections, soup, request);
}

double volume_of_region(const Soup& soup, RegionIndex region) {
    std::vector<Triangle> facets;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        if (soup.sides[f].back == region) facets.push_back(t);
        if (soup.sides[f].front == region) facets.push_back({t[0], t[2], t[1]});
    }
    return enclosed_volume(soup.vertices, facets);
}

double wall_area(const Soup& soup) {
    double area = 0;
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        if (soup.sides[f].is_wall()) area += triangle_area(soup.vertices, soup.facets[f]);
    return area;
}

void expect_regions_with_wall(const Soup& soup, double one, double two, double wall, double within) {
    ASSERT_EQ(soup.region_names.size(), 2U);
    EXPECT_NEAR(volume_of_region(soup, RegionIndex(0)), one, within);
    EXPECT_NEAR(volume_of_region(soup, RegionIndex(1)), two, within);
    EXPECT_NEAR(wall_area(soup), wall, within);
    EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
}

TEST(RepairSnap, BoxesSideBySideBecomeRegionsWithAWall) {
    constexpr double tolerance = 2e-4, apart = 1e-4;
    for (const double gap : {apart, -0.3 * apart})
        for (const int n : {1, 2, 3})
            for (const double shift : {0.0, 0.5 * apart, 0.3}) {
                SCOPED_TRACE(std::to_string(n) + ", " + std::to_string(gap) + ", " + std::to_string(shift));
                const Soup one = test::box(Vec3::Zero(), Vec3::Ones(), 2);
                const Soup two = test::box(Vec3(1 + gap, shift, shift), Vec3(2 + gap, 1 + shift, 1 + shift), n);
                Soup soup = two_bodies(one, two);
                const StepReport report = snap(soup, tolerance);
                EXPECT_GT(test::count(report, "facets made one with those of other bodies"), 0);
                EXPECT_LE(report.largest_move, 2 * tolerance);
                make_snap_regions(soup);
                const double side = shift > tolerance ? 1 - shift : 1;
                expect_regions_with_wall(soup, 1, 1, side * side, 6 * tolerance);
            }
}

TEST(RepairSnap, BoxesInAnyPlaceBecomeRegionsWithAWall) {
    constexpr double tolerance = 2e-4;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        const Vec3 shift(1 + random.between(-1e-4, 1e-4), random.between(-0.6, 0.6), random.between(-0.6, 0.6));
        const Vec3 axis(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        const Eigen::AngleAxisd turn(random.between(0, 3), axis.normalized());
        Soup soup = two_bodies(test::box(Vec3::Zero(), Vec3::Ones(), 2),
                               test::translated(test::box(Vec3::Zero(), Vec3::Ones(), 3), shift));
        for (Vec3& p : soup.vertices) p = turn * p;
        snap(soup, tolerance);
        make_snap_regions(soup);
        expect_regions_with_wall(soup, 1, 1, (1 - std::abs(shift.y())) * (1 - std::abs(shift.z())), 6 * tolerance);
    }
}

TEST(RepairSnap, WhatIsFarOrTheSameStays) {
    constexpr double tolerance = 1e-4;
    const Soup one = test::box(Vec3::Zero(), Vec3::Ones(), 2);
    const std::vector<Soup> all = {
        two_bodies(one, test::translated(test::box(Vec3::Zero(), Vec3::Ones(), 3), Vec3(1 + 2 * tolerance, 0, 0))),
        two_bodies(one, test::translated(one, Vec3(1, 0, 0))),
        two_bodies(one, test::box(Vec3(0.25, 0.25, 0.25), Vec3(0.75, 0.75, 0.75), 3)),
        one,
        {}};
    for (const Soup& given : all) {
        Soup soup = given;
        EXPECT_FALSE(snap(soup, tolerance).changed());
        EXPECT_TRUE(test::same(soup, given));
    }
}

TEST(RepairSnap, ThinPlatesAreRefused) {
    constexpr double tolerance = 1e-3;
    for (const double thickness : {0.3 * tolerance, 1.5 * tolerance}) {
        const Soup plate = test::box(Vec3(1 + tolerance / 2, 0, 0), Vec3(1 + tolerance / 2 + thickness, 1, 1), 3);
        const Soup given = two_bodies(test::box(Vec3::Zero(), Vec3::Ones(), 2), plate);
        Soup soup = given;
        const StepReport report = snap(soup, tolerance);
        EXPECT_GT(test::count(report, "facets near other bodies"), 0);
        EXPECT_FALSE(report.changed());
        EXPECT_TRUE(test::same(soup, given));
    }
}

}  // namespace
}  // namespace kerf
