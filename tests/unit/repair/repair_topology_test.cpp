// Damages to closed surfaces, and steps that undo them: what was a body is that body again, and what was none is left.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/damage.h"
#include "support/repair_steps.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "support/voxels.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/repair/inside/facet_copies.h"
#include "surface/repair/inside/touching_fans.h"
#include "surface/repair/repair.h"

namespace kerf {
namespace {

using test::apply;
using test::count;
using test::diagonal_of;
using test::facets_of;
using test::same;
using test::SeededNumbers;

// Closed, manifold, free of crossings, oriented outwards, and the same volume; nothing is left for the step.
void expect_body(Soup soup, double volume, double relative, RepairKind kind) {
    weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_TRUE(diagnosis.clean()) << diagnosis.summary(soup);
    EXPECT_TRUE(diagnosis.dropped.empty());
    EXPECT_NEAR(enclosed_volume(soup.vertices, soup.facets), volume, relative * volume);
    const Soup before = soup;
    EXPECT_FALSE(apply(kind, soup).changed());
    EXPECT_TRUE(same(before, soup));
}

double volume_of(const Soup& soup) { return enclosed_volume(soup.vertices, soup.facets); }

std::vector<Soup> bodies() {
    Soup hollow = test::icosphere(1, 0.5);
    for (Triangle& t : hollow.facets) std::swap(t[1], t[2]);
    return {test::tetrahedron(),
            test::box(Vec3::Zero(), Vec3(1, 2, 3), 3),
            test::icosphere(2),
            test::torus(1, 0.3, 16, 8),
            test::join(test::icosphere(2), hollow),
            test::prism(7, 1, 1e-6),
            test::voxel_surface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}})};
}

void shuffle(Soup& soup, SeededNumbers& random) {
    for (std::size_t i = soup.facets.size(); i > 1; --i) {
        const auto j = static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1));
        std::swap(soup.facets[i - 1], soup.facets[j]);
        std::swap(soup.patch[i - 1], soup.patch[j]);
    }
}

// One of the copies of each facet.
void drop_copies_of(Soup& soup) {
    std::vector<char> drop(soup.facets.size(), 0);
    for (const std::int32_t f : find_surplus_copies(soup.facets, false).copies) drop[f] = 1;
    drop_facets(soup, drop);
}

void add_facet(Soup& soup, const Triangle& facet) {
    soup.facets.push_back(facet);
    soup.patch.push_back(0);
}

// Divides a facet at the middle of one side, but not its neighbour.
void make_t_junction(Soup& soup, std::int32_t facet, std::size_t side) {
    const Triangle t = soup.facets[facet];
    const std::int32_t a = t[side], b = t[(side + 1) % 3], c = t[(side + 2) % 3];
    const auto middle = static_cast<std::int32_t>(soup.vertices.size());
    soup.vertices.emplace_back((soup.vertices[a] + soup.vertices[b]) / 2);
    soup.facets[facet] = {a, middle, c};
    add_facet(soup, {middle, b, c});
}

// A band of a box between two heights whose sides have n parts, without lids.
Soup open_cylinder(int n, double low, double high, bool has_lid_above) {
    Soup soup;
    for (int i = 0; i < n; ++i)
        for (const double z : {low, high}) {
            const double angle = 2 * std::numbers::pi * i / n;
            soup.vertices.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    soup.vertices.emplace_back(0, 0, has_lid_above ? high : low);
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t a = 2 * i, b = 2 * ((i + 1) % n);
        add_facet(soup, {a, b, b + 1});
        add_facet(soup, {a, b + 1, a + 1});
        if (has_lid_above)
            add_facet(soup, {2 * n, a + 1, b + 1});
        else
            add_facet(soup, {2 * n, b, a});
    }
    soup.patch_names = {"half"};
    return soup;
}

TEST(RepairTopology, CleanSurfacesComeBackByteForByte) {
    for (const Soup& body : bodies())
        for (const RepairKind kind : {RepairKind::weld, RepairKind::clean, RepairKind::stitch, RepairKind::orient,
                                      RepairKind::manifold, RepairKind::specks}) {
            Soup soup = body;
            const StepReport report = apply(kind, soup);
            EXPECT_FALSE(report.changed()) << name(kind);
            EXPECT_TRUE(same(soup, body)) << name(kind);
        }
}

TEST(RepairTopology, CopiesGoAndTheOrderOfFacetsDoesNotMatter) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SeededNumbers random(seed);
        const Soup body = test::icosphere(2);
        Soup soup = body;
        for (int i = 0; i < 15; ++i) {
            Triangle t = soup.facets[random.integer(0, 319)];
            if (random.with_chance(0.5)) std::swap(t[0], t[1]);
            add_facet(soup, t);
        }
        shuffle(soup, random);
        const StepReport report = apply(RepairKind::clean, soup);
        EXPECT_EQ(count(report, "copies of facets removed"), 15);
        apply(RepairKind::orient, soup);
        EXPECT_EQ(facets_of(soup), facets_of(body));
        expect_body(soup, volume_of(body), 0, RepairKind::clean);
    }
}

TEST(RepairTopology, AWholeBodyTwiceIsThereOnce) {
    for (const Soup& body : bodies()) {
        Soup soup = body;
        for (const Triangle& t : body.facets) add_facet(soup, t);
        EXPECT_EQ(count(apply(RepairKind::clean, soup), "copies of facets removed"),
                  static_cast<std::int64_t>(body.facets.size()));
        EXPECT_EQ(soup.facets, body.facets);
    }
}

TEST(RepairTopology, FinsOfTwoLayersGoButSheetsOfTwoStay) {
    Soup soup = test::box();
    const Soup body = soup;
    const Triangle t = soup.facets[0];
    soup.vertices.emplace_back(-1, -1, -1);
    add_facet(soup, {t[0], t[1], 8});
    add_facet(soup, {t[1], t[0], 8});
    EXPECT_EQ(count(apply(RepairKind::clean, soup), "facets folded upon each other removed"), 2);
    EXPECT_EQ(facets_of(soup), facets_of(body));

    Soup sheet = test::box(Vec3::Zero(), Vec3::Ones(), 2);
    sheet.facets.resize(8);  // one side
    sheet.patch.resize(8);
    for (std::size_t f = 0; f < 8; ++f) add_facet(sheet, {sheet.facets[f][0], sheet.facets[f][2], sheet.facets[f][1]});
    EXPECT_EQ(count(apply(RepairKind::clean, sheet), "copies of facets removed"), 8);
    EXPECT_EQ(sheet.facets.size(), 8U);
}

// One at a middle, and rows of them, as triangulations of sides with many collinear vertices have them.
TEST(RepairTopology, FacetsWithoutAreaGoWithoutAGap) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SeededNumbers random(seed);
        const Soup body = test::on_a_grid(test::icosphere(1));
        Soup soup = body;
        for (int i = 0; i < 12; ++i) {
            const std::int32_t f = random.integer(0, static_cast<int>(soup.facets.size()) - 1);
            const auto side = static_cast<std::size_t>(random.integer(0, 2));
            const std::int32_t a = soup.facets[f][side], b = soup.facets[f][(side + 1) % 3];
            make_t_junction(soup, f, side);
            add_facet(soup, {b, a, static_cast<std::int32_t>(soup.vertices.size()) - 1});
            std::swap(soup.facets.back()[0], soup.facets.back()[1]);  // turned as the facet that it was cut from
        }
        weld_exactly(soup);
        shuffle(soup, random);
        const StepReport report = apply(RepairKind::clean, soup);
        EXPECT_GT(count(report, "facets without area removed"), 0);
        EXPECT_TRUE(std::is_sorted(soup.polygon.begin(), soup.polygon.end()));
        apply(RepairKind::orient, soup);
        expect_body(soup, volume_of(body), 1e-12, RepairKind::clean);
    }
}

TEST(RepairTopology, FacetsWithoutCoordinatesGoAndWarpedFacesAreTaken) {
    Soup soup = test::icosphere(1);
    soup.vertices.emplace_back(Vec3::Constant(std::nan("")));
    add_facet(soup, {0, 1, 42});
    add_facet(soup, {0, 0, 1});
    soup.polygon.resize(82);
    for (std::size_t f = 0; f < 82; ++f) soup.polygon[f] = static_cast<std::int32_t>(f);
    soup.unfit_polygons = {3};
    const StepReport report = apply(RepairKind::clean, soup);
    EXPECT_EQ(count(report, "facets without finite coordinates removed"), 1);
    EXPECT_EQ(count(report, "facets with a repeated vertex removed"), 1);
    EXPECT_EQ(count(report, "warped faces taken as their triangles"), 1);
    expect_body(soup, volume_of(test::icosphere(1)), 0, RepairKind::clean);
}

TEST(RepairTopology, TurnedFacetsAndShellsAreTurnedBack) {
    for (const Soup& body : bodies())
        for (unsigned seed = 0; seed < 5; ++seed) {
            SeededNumbers random(seed);
            Soup soup = body;
            const bool inside_out = seed % 2 == 1;
            for (Triangle& t : soup.facets)
                if (random.with_chance(0.2) != inside_out) std::swap(t[1], t[2]);
            const bool is_nested = body.patch_names.size() > 1;
            apply(RepairKind::orient, soup);
            const auto wanted = facets_of(body);
            if (is_nested && inside_out) continue;  // its parity tells
            EXPECT_EQ(facets_of(soup), wanted);
        }
}

// Cubes that share a face are closed over edges of three facets alone.
TEST(RepairTopology, OutsideIsTurnedOutOverEdgesOfMany) {
    Soup soup = test::join(test::box(), test::box(Vec3(1, 0, 0), Vec3(2, 1, 1)));
    weld_exactly(soup);
    drop_copies_of(soup);
    ASSERT_EQ(soup.facets.size(), 22U);
    soup.polygon.clear();  // there is no file
    for (std::size_t f = 0; f < soup.facets.size(); f += 3) std::swap(soup.facets[f][0], soup.facets[f][1]);
    add_facet(soup, {soup.facets[0][0], soup.facets[0][1], static_cast<std::int32_t>(soup.vertices.size())});
    soup.vertices.emplace_back(-0.1, -0.1, -0.1);  // a fin, so that these are no regions
    apply(RepairKind::orient, soup);
    EXPECT_EQ(count(apply(RepairKind::manifold, soup), "facets of walls between bodies removed"), 2);
    apply(RepairKind::orient, soup);
    expect_body(soup, 2, 1e-12, RepairKind::manifold);
}

// Cells that share walls are regions as they are, whether walls are there once or twice; with a hole in one they are
// not.
TEST(RepairTopology, BodiesThatShareWallsAreRegionsAndStay) {
    Soup twice = test::join(test::join(test::box(), test::box(Vec3(1, 0, 0), Vec3(2, 1, 1))),
                            test::box(Vec3(0, 1, 1), Vec3(1, 2, 2)));
    weld_exactly(twice);
    Soup once = twice;
    once.facets.resize(24);
    once.patch.resize(24);
    drop_copies_of(once);
    EXPECT_EQ(once.facets.size(), 22U);
    for (const Soup& bodies : {twice, once})
        for (const RepairKind kind : {RepairKind::clean, RepairKind::orient, RepairKind::manifold}) {
            Soup soup = bodies;
            EXPECT_FALSE(apply(kind, soup).changed()) << name(kind);
            EXPECT_TRUE(same(soup, bodies));
        }
    test::remove_facet(twice, 0);
    EXPECT_EQ(count(apply(RepairKind::clean, twice), "facets folded upon each other removed"), 4);
}

TEST(RepairTopology, OpenShellsWithAnInsideAreTurnedOutwards) {
    Soup soup = test::icosphere(2);
    soup.facets.resize(300);
    soup.patch.resize(300);
    const Soup open = soup;
    for (Triangle& t : soup.facets) std::swap(t[1], t[2]);
    apply(RepairKind::orient, soup);
    EXPECT_EQ(facets_of(soup), facets_of(open));
}

// Whether the hole is in the void, in what is around it or in both; and all of that inside out.
TEST(RepairTopology, VoidsStayVoidsThoughSomethingHasAHole) {
    const Soup outer = test::icosphere(2), inner = test::inside_out(test::icosphere(2, 0.6));
    for (int holes = 0; holes < 4; ++holes) {
        Soup hollow = test::join(outer, inner);
        if (holes % 2 == 1) test::remove_facet(hollow, static_cast<std::int32_t>(hollow.facets.size()) - 1);
        if (holes / 2 == 1) test::remove_facet(hollow, 0);
        for (Soup soup : {hollow, test::inside_out(hollow)}) {
            apply(RepairKind::orient, soup);
            EXPECT_EQ(facets_of(soup), facets_of(hollow)) << holes;
        }
    }
}

TEST(RepairTopology, MoebiusStripsAreLeftAndSaid) {
    Soup soup;
    constexpr int n = 12;
    for (int i = 0; i < n; ++i)
        for (const double side : {-0.3, 0.3}) {
            const double a = 2 * std::numbers::pi * i / n, r = 1 + side * std::cos(a / 2);
            soup.vertices.emplace_back(r * std::cos(a), r * std::sin(a), side * std::sin(a / 2));
        }
    for (std::int32_t i = 0; i < n; ++i) {
        const bool is_last = i + 1 == n;
        const std::int32_t a = 2 * i, b = is_last ? 1 : a + 2, c = is_last ? 0 : a + 3;
        add_facet(soup, {a, b, c});
        add_facet(soup, {a, c, a + 1});
    }
    soup.patch_names = {"strip"};
    const Soup before = soup;
    const StepReport report = apply(RepairKind::orient, soup);
    EXPECT_FALSE(report.changed());
    EXPECT_TRUE(same(soup, before));
    EXPECT_EQ(count(report, "one-sided shells"), 1);
}

// Whatever cubes touch at: corners, edges, edges whose ends have one fan.
TEST(RepairTopology, CubesThatTouchComeApart) {
    const auto expect_apart = [](const test::Voxels& voxels) {
        Soup soup = test::voxel_surface(voxels);
        const double volume = volume_of(soup);
        const StepReport report = apply(RepairKind::manifold, soup);
        EXPECT_LE(report.largest_move, 1e-3 * diagonal_of(soup));
        expect_body(soup, volume, 1e-3, RepairKind::manifold);
    };
    expect_apart(test::notched_voxels());
    for (unsigned seed = 0; seed < 60; ++seed) {
        SeededNumbers random(seed);
        expect_apart(test::random_voxels(4, random.between(0.2, 0.8), random));
    }
}

TEST(RepairTopology, FinsOfOneLayerAndWallsGo) {
    Soup soup = test::box(Vec3::Zero(), Vec3::Ones(), 2);
    const Soup body = soup;
    soup.vertices.emplace_back(50, 50, 50);
    const Triangle t = soup.facets[0];
    add_facet(soup, {t[0], t[1], static_cast<std::int32_t>(soup.vertices.size()) - 1});
    EXPECT_EQ(count(apply(RepairKind::manifold, soup), "facets of fins removed"), 0) << "a fin larger than the body";
    soup.vertices.back() = Vec3(-1, -1, -1);
    EXPECT_EQ(count(apply(RepairKind::manifold, soup), "facets of fins removed"), 1);
    EXPECT_EQ(facets_of(soup), facets_of(body));
}

TEST(RepairTopology, CrackedSurfacesAreStitched) {
    for (unsigned seed = 0; seed < 6; ++seed)
        for (const double jitter : {1e-9, 1e-6, 1e-4}) {
            const Soup body = test::icosphere(2);
            Soup soup = test::cracked(body, jitter, seed);
            const StepReport report = apply(jitter < 1e-8 ? RepairKind::weld : RepairKind::stitch, soup);
            EXPECT_LE(report.largest_move, 1e-3 * diagonal_of(soup));
            EXPECT_EQ(soup.facets.size(), body.facets.size());
            expect_body(soup, volume_of(body), 1e-2, RepairKind::stitch);
        }
}

TEST(RepairTopology, JunctionsAreStitched) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SeededNumbers random(seed);
        const Soup body = test::on_a_grid(test::icosphere(2));
        Soup soup = body;
        for (int i = 0; i < 60; ++i)
            make_t_junction(soup, random.integer(0, static_cast<int>(soup.facets.size()) - 1),
                            static_cast<std::size_t>(random.integer(0, 2)));
        weld_exactly(soup);
        shuffle(soup, random);
        apply(RepairKind::stitch, soup);
        EXPECT_TRUE(std::is_sorted(soup.polygon.begin(), soup.polygon.end()));
        expect_body(soup, volume_of(body), 1e-12, RepairKind::stitch);
    }
}

// A vertex on an edge comes before another vertex, which is farther away but within the tolerance.
TEST(RepairTopology, WhatFitsExactlyIsJoinedFirst) {
    Soup soup = test::on_a_grid(test::icosphere(2));
    const double volume = volume_of(soup);
    for (std::int32_t f = 0; f < 320; f += 2) make_t_junction(soup, f, 0);
    weld_exactly(soup);
    apply(RepairKind::stitch, soup, {.amount = 0.2, .bound = 0.2});
    expect_body(soup, volume, 1e-12, RepairKind::stitch);
}

TEST(RepairTopology, SidesOfACrackWithOtherVerticesAreStitched) {
    for (const int n : {12, 17, 24, 40})
        for (const int m : {12, 31, 40}) {
            Soup soup = test::join(open_cylinder(n, -1, 0, false), open_cylinder(m, 1e-3, 1, true));
            const double volume = (n * std::sin(2 * std::numbers::pi / n) + m * std::sin(2 * std::numbers::pi / m)) / 2;
            apply(RepairKind::stitch, soup, {.amount = 0.05, .bound = 0.05});
            expect_body(soup, volume, 0.03, RepairKind::stitch);
        }
}

TEST(RepairTopology, HolesStayAndThinWallsDoNotMeet) {
    Soup hole = test::icosphere(3);
    test::remove_facet(hole, 100);
    for (const double amount : {0.01, 0.1, 0.5}) {
        Soup soup = hole;
        EXPECT_FALSE(apply(RepairKind::stitch, soup, {.amount = amount, .bound = amount}).changed()) << amount;
        EXPECT_TRUE(same(soup, hole));
    }
    const Soup plate = test::box(Vec3::Zero(), Vec3(1, 1, 1e-5), {4, 4, 1});
    Soup soup = plate;
    EXPECT_FALSE(apply(RepairKind::weld, soup, {.amount = 1e-3}).changed());
    EXPECT_TRUE(same(soup, plate));
}

TEST(RepairTopology, SpecksGoButNotTheLargest) {
    const Soup body = test::icosphere(2);
    Soup soup = test::join(test::join(test::icosphere(0, 1e-4, Vec3(2, 0, 0)), body), test::icosphere(1, 0.01));
    EXPECT_EQ(count(apply(RepairKind::specks, soup), "specks removed"), 1);
    EXPECT_EQ(soup.facets.size(), body.facets.size() + 80);
    apply(RepairKind::specks, soup, {.amount = 100});
    EXPECT_EQ(facets_of(soup), facets_of(body));
}

// Two cones with one apex, and plates through both: the facets there cross as they did before, however often. Boxes at
// the apex cross none any more.
TEST(TouchingFans, ComeApartWhereTheirFacetsCrossOthersAlready) {
    for (const int plates : {1, 200}) {
        SCOPED_TRACE(plates);
        constexpr int n = 400;
        Soup soup = test::twisted_cylinder(n, 1, 1, 1, 0);
        const auto apex = static_cast<std::int32_t>(soup.vertices.size());
        soup.vertices.emplace_back(0, 0, 0.5);
        std::erase_if(soup.facets, [&](const Triangle& t) { return std::max({t[0], t[1], t[2]}) < 2 * n; });
        for (std::int32_t i = 0; i < n; ++i) {
            const std::int32_t next = (i + 1) % n;
            soup.facets.push_back({i, next, apex});
            soup.facets.push_back({n + next, n + i, apex});
        }
        soup.patch.assign(soup.facets.size(), 0);
        for (int i = 0; i < plates; ++i) {
            const double z = 0.1 + 0.3 * i / plates, thickness = 0.1 / plates;
            for (const double low : {z, 1 - z - thickness})
                soup = test::join(soup, test::box(Vec3(-2, -2, low), Vec3(2, 2, low + thickness), 1));
        }
        for (const double z : {0.5 - 3e-5, 0.5 + 3e-5}) {
            const Vec3 centre(0, 0, z), half = Vec3::Constant(2e-5);
            soup = test::join(soup, test::box(centre - half, centre + half, 1));
        }
        const std::size_t vertices = soup.vertices.size();
        const FanSeparation separation = separate_fans(soup, 1e-3);
        EXPECT_EQ(soup.vertices.size(), vertices + 1);
        EXPECT_GT(separation.largest_move, 0);
        for (const RepairAction& action : separation.actions)
            EXPECT_TRUE(*action.refused_because == '\0' || action.count == 0) << action.refused_because;
    }
}

// Boxes that touch along an edge come apart, which would leave a crack if the outside were meshed: then they are
// joined.
TEST(TouchingBodies, AreJoinedWhereTheOutsideIsMeshed) {
    for (const bool outside : {false, true}) {
        Soup soup = test::join(test::box(Vec3::Zero(), Vec3::Ones(), 2), test::box(Vec3(1, 1, 0), Vec3(2, 2, 1), 2));
        weld_exactly(soup);
        RepairPlan plan = parse_repair_plan("repair", "exact");
        plan.outside_is_meshed = outside;
        repair(soup, plan);
        EXPECT_TRUE(diagnose(soup).clean()) << outside;
        EXPECT_EQ(find_shells(test::to_surface(soup)).count, outside ? 1 : 2);
    }
}

}  // namespace
}  // namespace kerf
