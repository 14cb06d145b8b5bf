// Holes cut into closed surfaces are filled so that what was there is nearly there again; ends get caps.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "run/prepare/input.h"
#include "support/assets.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/repair/repair.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {
namespace {

using test::box;
using test::join;
using test::translated;

RepairReport repaired(Soup& soup, const std::string& steps) { return repair(soup, parse_repair_plan("repair", steps)); }

// Of the first action of that name, refused or not.
std::int64_t count_of(const RepairReport& report, const std::string& many) {
    for (const StepReport& step : report.steps)
        for (const RepairAction& action : step.actions)
            if (action.many == many) return action.count;
    return 0;
}

std::string refusals(const RepairReport& report) {
    std::string all;
    for (const StepReport& step : report.steps)
        for (const RepairAction& action : step.actions)
            if (*action.refused_because != '\0') all += std::string(action.refused_because) + "\n";
    return all;
}

bool is_fit(const Soup& soup) { return check_soup(soup, {}).diagnosis.clean(); }

double volume(const Soup& soup) { return enclosed_volume(soup.vertices, soup.facets); }

// Without facets around `count` places, one of which has as many rings of facets as `rings` says.
Soup with_holes_cut(Soup soup, int count, int rings, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<char> drop(soup.facets.size(), 0);
    for (int i = 0; i < count; ++i) {
        std::vector<char> is_near(soup.vertices.size(), 0);
        const std::size_t middle = random() % soup.facets.size();
        drop[middle] = 1;
        for (const std::int32_t v : soup.facets[middle]) is_near[v] = 1;
        for (int ring = 1; ring < rings; ++ring) {
            std::vector<std::size_t> reached;
            for (std::size_t f = 0; f < soup.facets.size(); ++f)
                for (const std::int32_t v : soup.facets[f])
                    if (is_near[v]) reached.push_back(f);
            for (const std::size_t f : reached) {
                drop[f] = 1;
                for (const std::int32_t v : soup.facets[f]) is_near[v] = 1;
            }
        }
    }
    drop_facets(soup, drop);
    drop_unused_vertices(soup);
    return soup;
}

Soup without(Soup soup, const std::function<bool(const Vec3&)>& is_gone) {
    std::vector<char> drop;
    for (const Triangle& t : soup.facets)
        drop.push_back(is_gone((soup.vertices[t[0]] + soup.vertices[t[1]] + soup.vertices[t[2]]) / 3));
    drop_facets(soup, drop);
    drop_unused_vertices(soup);
    return soup;
}

// A pipe around z, without ends.
Soup pipe(int around, int along, double bottom_radius, double top_radius, double height) {
    Soup soup;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around, part = static_cast<double>(j) / along;
            const double radius = bottom_radius + (top_radius - bottom_radius) * part;
            soup.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * part);
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            soup.facets.push_back({a, b, b + around});
            soup.facets.push_back({a, b + around, a + around});
        }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"pipe"};
    return soup;
}

TEST(RepairHoles, SmallOnesGetTheVolumeBackAndPassTheCheck) {
    std::vector<Soup> shapes = {box(Vec3(0, 0, 0), Vec3(1, 2, 3), 12), test::icosphere(4), test::torus(3, 1, 48, 32),
                                test::uv_sphere(30, 60), test::nested_boxes(2, 10)};
    for (const char* asset : {"cube", "cylinder", "pipe_with_holes"})
        shapes.push_back(check_input(test::asset_path(asset), {}).soup);
    for (const Soup& shape : shapes)
        for (unsigned seed = 1; seed <= 6; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            Soup soup = with_holes_cut(shape, 1 + seed % 2, seed % 2 + 1, seed);
            const std::size_t left = soup.facets.size();
            const RepairReport report = repaired(soup, "holes");
            EXPECT_TRUE(report.changed());
            EXPECT_EQ(refusals(report), "");
            EXPECT_TRUE(is_fit(soup));
            EXPECT_NEAR(volume(soup) / volume(shape), 1, 1e-3);
            for (std::size_t f = left; f < soup.facets.size(); ++f)
                EXPECT_EQ(soup.patch_names[soup.patch[f]], "filled");
            EXPECT_TRUE(std::is_sorted(soup.polygon.begin(), soup.polygon.end()));
        }
}

TEST(RepairHoles, LargeOnesAreClosedWithoutCrossings) {
    for (const Soup& shape : {box(Vec3(0, 0, 0), Vec3(1, 2, 3), 8), test::icosphere(3), test::torus(3, 1, 24, 16)})
        for (unsigned seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            Soup soup = with_holes_cut(shape, 3, 3, seed);
            const RepairReport report = repaired(soup, "holes");
            EXPECT_TRUE(!refusals(report).empty() || is_fit(soup));
        }
}

// A flat filling of a hole with the angular radius t is 1 - cos(t) below the sphere.
TEST(RepairHoles, ASphereGoesOnAsOne) {
    const Soup sphere = test::icosphere(5);
    for (const double angle : {0.1, 0.2, 0.4, 0.6}) {
        SCOPED_TRACE(angle);
        const Vec3 axis = Vec3(1, 2, 3).normalized();
        Soup soup = without(sphere, [&](const Vec3& p) { return p.normalized().dot(axis) > std::cos(angle); });
        const std::size_t left = soup.vertices.size();
        repaired(soup, "holes");
        ASSERT_GT(soup.vertices.size(), left);
        double error = 0;
        for (std::size_t v = left; v < soup.vertices.size(); ++v)
            error = std::max(error, std::abs(soup.vertices[v].norm() - 1));
        EXPECT_LT(error, 0.05 * (1 - std::cos(angle))) << error;
        EXPECT_TRUE(is_fit(soup));
    }
}

TEST(RepairHoles, PlanesStayPlanesExactly) {
    const Soup cube = box(Vec3(0.1, 0.2, 0.3), Vec3(1.1, 0.7, 2.3), 12);
    for (int axis = 0; axis < 3; ++axis) {
        const double plane = box_around(cube.vertices).max()[axis];
        Vec3 middle = (box_around(cube.vertices).min() + box_around(cube.vertices).max()) / 2;
        middle[axis] = plane;
        Soup within = without(cube, [&](const Vec3& p) { return (p - middle).norm() < 0.2; });
        Soup whole = without(cube, [&](const Vec3& p) { return p[axis] > plane - 1e-9; });
        for (Soup* soup : {&within, &whole}) {
            const std::size_t left = soup->vertices.size();
            repaired(*soup, "holes");
            ASSERT_GT(soup->vertices.size(), left);
            for (std::size_t v = left; v < soup->vertices.size(); ++v) EXPECT_EQ(soup->vertices[v][axis], plane);
            EXPECT_NEAR(volume(*soup), 1, 1e-12);
            EXPECT_TRUE(is_fit(*soup));
        }
    }
}

TEST(RepairHoles, WhatIsClosedIsNotTouched) {
    for (const Soup& shape : {box(), test::icosphere(2), test::torus(3, 1, 12, 8), test::nested_boxes(2, 3)}) {
        Soup soup = shape;
        EXPECT_FALSE(repaired(soup, "caps,holes,thicken").changed());
        EXPECT_EQ(soup.facets, shape.facets);
        EXPECT_EQ(soup.vertices, shape.vertices);
        EXPECT_EQ(soup.patch_names, shape.patch_names);
    }
}

// Rims of facets that are turned against each other are loops all the same.
TEST(RepairHoles, DoNotDependOnHowFacetsAreTurned) {
    Soup soup = with_holes_cut(test::icosphere(3), 4, 2, 5), turned = soup;
    std::mt19937 random(1);
    for (Triangle& t : turned.facets)
        if (random() % 3 == 0) std::swap(t[1], t[2]);
    EXPECT_EQ(count_of(repaired(soup, "holes"), "holes filled"), count_of(repaired(turned, "holes"), "holes filled"));
    EXPECT_EQ(turned.vertices.size(), soup.vertices.size());
    EXPECT_TRUE(is_fit(turned));
}

TEST(RepairHoles, BandsCloseWhatTwoRimsHaveBetweenThem) {
    Soup wall = join(pipe(24, 6, 1, 1, 2), test::inside_out(pipe(24, 6, 0.8, 0.8, 2)));
    EXPECT_EQ(count_of(repaired(wall, "holes"), "gaps between two rims closed"), 2);
    EXPECT_TRUE(is_fit(wall));

    Soup broken = join(pipe(24, 6, 1, 1, 2), translated(pipe(24, 6, 1, 1, 2), Vec3(0, 0, 2.4)));
    const RepairReport report = repaired(broken, "holes");
    EXPECT_EQ(count_of(report, "gaps between two rims closed"), 1);
    EXPECT_EQ(count_of(report, "holes filled"), 2);
    EXPECT_TRUE(is_fit(broken));
    EXPECT_NEAR(volume(broken), 4.4 * 12 * std::sin(2 * std::numbers::pi / 24), 0.05);

    Soup island = box(Vec3::Zero(), Vec3::Ones(), 12);  // a piece of a face is left in a hole
    island = without(island, [](const Vec3& p) {
        return p.z() > 1 - 1e-9 && std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) < 0.4 &&
               std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) > 0.16;
    });
    EXPECT_EQ(count_of(repaired(island, "holes"), "gaps between two rims closed"), 1);
    EXPECT_TRUE(is_fit(island));
    EXPECT_NEAR(volume(island), 1, 1e-12);
}

TEST(RepairHoles, AShortPipeGetsTwoLids) {
    Soup soup = pipe(24, 1, 1, 1, 0.2);
    EXPECT_EQ(count_of(repaired(soup, "holes"), "holes filled"), 2);
    EXPECT_TRUE(is_fit(soup));
}

TEST(RepairHoles, OnesThatTouchAtAVertexAreFilled) {
    const Soup whole = test::icosphere(2);
    for (std::int32_t v = 0; v < 20; ++v) {
        std::vector<std::size_t> at;
        for (std::size_t f = 0; f < whole.facets.size(); ++f)
            if (std::count(whole.facets[f].begin(), whole.facets[f].end(), v) > 0) at.push_back(f);
        const auto shared = [&](std::size_t f, std::size_t g) {
            return std::count_if(whole.facets[f].begin(), whole.facets[f].end(), [&](std::int32_t w) {
                return std::count(whole.facets[g].begin(), whole.facets[g].end(), w) > 0;
            });
        };
        std::vector<char> drop(whole.facets.size(), 0);
        drop[at[0]] = 1;
        for (const std::size_t f : at)
            if (shared(at[0], f) == 1) {
                drop[f] = 1;
                break;
            }
        Soup soup = whole;
        drop_facets(soup, drop);
        repaired(soup, "holes");
        EXPECT_TRUE(is_fit(soup)) << v;
    }
}

TEST(RepairHoles, LongRimsAreSpannedInPlanesAndInSpace) {
    for (const double wave : {0.0, 0.5, 4.0}) {
        Soup soup = pipe(500, 1, 10, 10, 1);
        for (std::size_t v = soup.vertices.size() / 2; v < soup.vertices.size(); ++v)
            soup.vertices[v].z() += wave + wave * std::sin(std::atan2(soup.vertices[v].y(), soup.vertices[v].x()) * 6);
        const RepairReport report = repaired(soup, "holes=100000");
        EXPECT_EQ(count_of(report, "holes filled"), 2) << wave;
        EXPECT_TRUE(is_fit(soup)) << wave;
    }
}

TEST(RepairHoles, WhatCannotBeFilledIsSaidWithItsReason) {
    Soup tall = pipe(24, 6, 1, 1, 2);
    EXPECT_NE(refusals(repaired(tall, "holes=12")).find("more edges than holes=N allows"), std::string::npos);

    Soup sheet = without(box(Vec3::Zero(), Vec3::Ones(), 4), [](const Vec3& p) { return p.z() < 1 - 1e-9; });
    EXPECT_NE(refusals(repaired(sheet, "holes")).find("fold back"), std::string::npos);

    Soup fan = join(box(), {});
    fan.vertices.emplace_back(0.5, 0.5, 3);  // a third facet at an edge
    fan.facets.push_back({fan.facets[0][0], fan.facets[0][1], static_cast<std::int32_t>(fan.vertices.size()) - 1});
    fan.patch.push_back(0);
    EXPECT_NE(refusals(repaired(fan, "holes")).find("more than two facets"), std::string::npos);
}

// A rod through a hole: without intersections it stays open, before them it is filled across the rod.
TEST(RepairHoles, AFillingThatWouldCrossIsLeftUnlessIntersectionsFollow) {
    const Soup cube = without(box(Vec3::Zero(), Vec3::Ones(), 12),
                              [](const Vec3& p) { return p.z() > 1 - 1e-9 && (p - Vec3(0.5, 0.5, 1)).norm() < 0.3; });
    const Soup rod = box(Vec3(0.45, 0.45, 0.5), Vec3(0.55, 0.55, 1.5));
    Soup soup = join(cube, rod);
    const RepairReport report = repaired(soup, "holes");
    EXPECT_FALSE(report.changed());
    EXPECT_NE(refusals(report).find("crosses"), std::string::npos);

    StepReport alone{RepairKind::holes, {}};
    const RepairPlan plan = parse_repair_plan("repair", "holes,intersections");
    StepRequest request;
    request.amount = 200;
    request.plan = &plan;
    holes_step(soup, request, alone);
    EXPECT_TRUE(alone.changed());
    for (const std::int32_t partner : edge_partners(soup.facets)) EXPECT_GE(partner, 0);
}

TEST(RepairCaps, EndsGetPatchesOfTheirOwnTheLargestFirst) {
    for (const double wave : {0.0, 0.1}) {
        Soup soup = pipe(32, 20, 1, 0.7, 5);
        for (std::size_t v = soup.vertices.size() - 32; v < soup.vertices.size(); ++v)
            soup.vertices[v].z() += wave * std::sin(std::atan2(soup.vertices[v].y(), soup.vertices[v].x()) * 3);
        std::vector<char> drop(soup.facets.size(), 0);
        drop[400] = 1;  // a hole in its wall is none of the ends
        drop_facets(soup, drop);
        const std::size_t left = soup.facets.size();
        const RepairReport report = repaired(soup, "caps,holes");
        EXPECT_EQ(count_of(report, "openings capped"), 2);
        EXPECT_EQ(count_of(report, "holes filled"), 1);
        EXPECT_EQ(soup.patch_names, (std::vector<std::string>{"pipe", "cap_1", "cap_2", "filled"}));
        EXPECT_TRUE(is_fit(soup));
        for (std::size_t f = left; f < soup.facets.size(); ++f)
            for (const std::int32_t v : soup.facets[f]) {
                const bool is_bottom = soup.patch[f] == 1, is_top = soup.patch[f] == 2;
                EXPECT_TRUE(!is_bottom || soup.vertices[v].z() == 0);
                EXPECT_TRUE(!is_top || std::abs(soup.vertices[v].z() - 5) <= wave * 1.01 + 1e-12);
            }
    }
}

TEST(RepairCaps, WhatIsNoEndIsLeft) {
    Soup few = pipe(6, 3, 1, 1, 2);
    EXPECT_NE(refusals(repaired(few, "caps")).find("fewer edges"), std::string::npos);
    EXPECT_EQ(count_of(repaired(few, "caps=6"), "openings capped"), 2);
    EXPECT_TRUE(is_fit(few));
    Soup dented = without(test::icosphere(4), [](const Vec3& p) { return p.z() > 0.95; });
    EXPECT_NE(refusals(repaired(dented, "caps")).find("goes on"), std::string::npos);
}

}  // namespace
}  // namespace kerf
