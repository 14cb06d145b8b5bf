// Rims, copies, welding with a tolerance, filled holes, regions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "run/prepare/input.h"
#include "support/damage.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/open_loops.h"
#include "surface/diagnosis/superfluous_facets.h"
#include "surface/regions/regions.h"
#include "surface/repair/repair.h"

namespace kerf {
namespace {

using test::box;
using test::join;
using test::translated;
using Numbers = std::vector<std::int32_t>;

std::vector<Soup> whole_shapes() {
    return {box(Vec3(0, 0, 0), Vec3(1, 2, 3), 4), test::icosphere(2), test::uv_sphere(9, 11), test::torus(3, 1, 12, 8),
            test::nested_boxes(2, 3)};
}

// Removes facets of random places, each with the facets around it now and then.
Soup with_holes(Soup soup, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<char> drop(soup.facets.size(), 0);
    for (int i = 0; i < 4; ++i) {
        const Triangle& t = soup.facets[random() % soup.facets.size()];
        for (std::size_t f = 0; f < drop.size(); ++f) {
            const Triangle& s = soup.facets[f];
            drop[f] |= s == t || (i % 2 && std::find(s.begin(), s.end(), t[0]) != s.end());
        }
    }
    drop_facets(soup, drop);
    drop_unused_vertices(soup);
    return soup;
}

TEST(OpenLoops, HoldEveryOpenEdgeOnceAgainstTheDirectionOfItsFacet) {
    for (const Soup& shape : whole_shapes())
        for (unsigned seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            const Soup soup = with_holes(shape, seed);
            std::set<std::pair<std::int32_t, std::int32_t>> sides, found;
            for (const Triangle& t : soup.facets)
                for (std::size_t i = 0; i < 3; ++i) sides.emplace(t[i], t[(i + 1) % 3]);
            std::size_t open = 0;
            for (const auto& [a, b] : sides) open += !sides.count({b, a});
            std::int32_t last_lowest = -1;
            for (const OpenLoop& loop : find_open_loops(soup.vertices, soup.facets)) {
                EXPECT_TRUE(loop.closed);
                ASSERT_EQ(loop.vertices.size(), loop.facets.size());
                EXPECT_EQ(std::set(loop.vertices.begin(), loop.vertices.end()).size(), loop.vertices.size());
                double length = 0;
                for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
                    const std::int32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.vertices.size()];
                    EXPECT_TRUE(found.emplace(a, b).second);
                    EXPECT_TRUE(sides.count({b, a}) && !sides.count({a, b}));
                    EXPECT_EQ(test::facets_with(soup, {a, b}), Numbers{loop.facets[i]});
                    length += (soup.vertices[b] - soup.vertices[a]).norm();
                }
                EXPECT_NEAR(loop.length, length, 1e-12);
                const std::int32_t lowest = *std::min_element(loop.facets.begin(), loop.facets.end());
                EXPECT_GE(lowest, last_lowest);
                last_lowest = lowest;
            }
            EXPECT_EQ(found.size(), open);
        }
}

TEST(OpenLoops, RimsThatMeetInAVertexAreLoopsOfTheirOwn) {
    const std::vector<Vec3> vertices = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0), Vec3(-6, 0, 0), Vec3(0, -8, 0)};
    const std::vector<OpenLoop> loops = find_open_loops(vertices, {{0, 1, 2}, {0, 3, 4}});
    ASSERT_EQ(loops.size(), 2u);
    for (const OpenLoop& loop : loops) {
        EXPECT_TRUE(loop.closed);
        EXPECT_EQ(loop.vertices.size(), 3u);
    }
    EXPECT_EQ(loops[0].facets, (Numbers{0, 0, 0}));
    EXPECT_EQ(loops[0].length, 12);
    EXPECT_EQ(loops[1].length, 24);
}

TEST(OpenLoops, FacetsOfOppositeOrientationMakeChains) {
    const std::vector<Vec3> square = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    const std::vector<OpenLoop> loops = find_open_loops(square, {{0, 1, 2}, {0, 3, 2}});
    ASSERT_EQ(loops.size(), 2u);
    for (const OpenLoop& loop : loops) {
        EXPECT_FALSE(loop.closed);
        EXPECT_EQ(loop.vertices.size(), 3u);
        EXPECT_EQ(loop.vertices.front(), 2);
        EXPECT_EQ(loop.vertices.back(), 0);
        EXPECT_EQ(loop.length, 2);
    }
    EXPECT_EQ(loops[0].facets, (Numbers{0, 0}));
    EXPECT_EQ(loops[1].facets, (Numbers{1, 1}));
}

TEST(SuperfluousFacets, KeepWhatLeavesTwoFacetsAtEveryEdge) {
    Soup soup = box();
    const SuperfluousFacets none = find_superfluous_facets(soup.facets);
    EXPECT_TRUE(none.copies.empty() && none.repeated_vertex.empty() && none.coincident_shells.empty());

    soup.facets.push_back({soup.facets[3][1], soup.facets[3][0], soup.facets[3][2]});
    soup.facets.push_back({4, 4, 5});
    soup.facets.push_back(soup.facets[3]);
    SuperfluousFacets found = find_superfluous_facets(soup.facets);
    EXPECT_EQ(found.repeated_vertex, Numbers{13});
    ASSERT_EQ(found.copies.size(), 1u);
    EXPECT_EQ(found.copies[0].facets, (Numbers{3, 12, 14}));
    EXPECT_EQ(found.copies[0].keep, 1);
    EXPECT_EQ(found.copies[0].shell, -1);

    const Triangle fin = {soup.facets[0][0], soup.facets[0][1], 8};  // stands on an edge, twice
    soup = box();
    soup.facets.insert(soup.facets.end(), {fin, fin});
    found = find_superfluous_facets(soup.facets);
    ASSERT_EQ(found.copies.size(), 1u);
    EXPECT_EQ(found.copies[0].keep, 0);

    soup = box();  // at a hole neither number is right
    soup.facets.push_back(soup.facets[0]);
    soup.facets.erase(soup.facets.begin() + 1);
    found = find_superfluous_facets(soup.facets);
    ASSERT_EQ(found.copies.size(), 1u);
    EXPECT_EQ(found.copies[0].facets, (Numbers{0, 11}));
    EXPECT_EQ(found.copies[0].keep, -1);
}

TEST(SuperfluousFacets, ShellsOfNothingButCopies) {
    std::vector<Triangle> facets = join(box(), translated(box(), Vec3(5, 0, 0))).facets;
    facets.insert(facets.end(), facets.begin() + 12, facets.begin() + 24);
    const SuperfluousFacets found = find_superfluous_facets(facets);
    ASSERT_EQ(found.coincident_shells.size(), 1u);
    EXPECT_EQ(found.coincident_shells[0].size(), 24u);
    EXPECT_EQ(found.coincident_shells[0].front(), 12);
    EXPECT_EQ(found.coincident_shells[0].back(), 35);
    EXPECT_EQ(found.copies.size(), 12u);
    for (const FacetCopies& copies : found.copies) EXPECT_EQ(copies.shell, 0);
}

// The definition, by all pairs.
Numbers first_within(const std::vector<Vec3>& vertices, double tolerance) {
    Numbers first;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        first.push_back(static_cast<std::int32_t>(v));
        for (std::size_t u = 0; u < v && first[v] == static_cast<std::int32_t>(v); ++u)
            if (first[u] == static_cast<std::int32_t>(u) && (vertices[u] - vertices[v]).norm() <= tolerance)
                first[v] = static_cast<std::int32_t>(u);
    }
    return first;
}

TEST(WeldWithin, KeepsTheFirstOfEveryGroupAndNothingCloseToIt) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> place(-1, 1);
        const double tolerance = seed % 3 ? 0.2 : 1e-3;
        Soup soup;
        for (int v = 0; v < 300; ++v) {
            const double x = place(random), y = place(random), z = place(random);
            soup.vertices.push_back(v % 3 ? Vec3(x, y, z) : Vec3(x, y, z) * 1e-3);
            soup.facets.push_back({v, v, v});
        }
        soup.patch.assign(soup.facets.size(), 0);
        const std::vector<Vec3> before = soup.vertices;
        const Numbers first = first_within(before, tolerance);
        const std::int64_t removed = weld_within(soup, tolerance);
        EXPECT_EQ(removed, static_cast<std::int64_t>(before.size() - soup.vertices.size()));
        EXPECT_GT(removed, 0);
        for (std::size_t v = 0; v < before.size(); ++v) {
            EXPECT_EQ(soup.vertices[soup.facets[v][0]], before[first[v]]);
            EXPECT_EQ(soup.file_vertices({soup.facets[v][0]}), Numbers{first[v]});
        }
        for (std::size_t a = 0; a < soup.vertices.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_GT((soup.vertices[a] - soup.vertices[b]).norm(), tolerance) << a << ' ' << b;
        EXPECT_EQ(weld_within(soup, tolerance), 0);
    }
}

// Coordinates that differ in their last bits only, where sums round.
TEST(WeldWithin, ObeysToleranceOfAFewUnitsInTheLastPlace) {
    constexpr double unit = 0x1p-50;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup;
        for (std::int32_t v = 0; v < 20; ++v) {
            soup.vertices.emplace_back(1 + unit * static_cast<double>(random() % 64), 1, -1);
            soup.facets.push_back({v, v, v});
        }
        soup.patch.assign(soup.facets.size(), 0);
        const double tolerance = unit * std::uniform_real_distribution<double>(1, 4)(random);
        const Numbers first = first_within(soup.vertices, tolerance);
        weld_within(soup, tolerance);
        for (std::size_t v = 0; v < first.size(); ++v)
            EXPECT_EQ(soup.file_vertices({soup.facets[v][0]}), Numbers{first[v]});
    }
}

TEST(WeldWithin, LeavesWhatIsNotFinite) {
    Soup soup;
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    soup.vertices = {Vec3(nan, 0, 0), Vec3(nan, 0, 0), Vec3(infinity, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 1e-9)};
    EXPECT_EQ(weld_within(soup, 1e-6), 1);
    EXPECT_EQ(soup.vertices.size(), 4u);
}

TEST(WeldWithin, MendsSurfacesWhoseFacetsHaveVerticesThatAreNearlyEqual) {
    for (const Soup& shape : whole_shapes())
        for (unsigned seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            const Soup cracked = test::cracked(shape, 1e-9, seed);
            EXPECT_FALSE(check_soup(cracked).diagnosis.clean());
            InputOptions options;
            options.repairs.weld_tolerance = 1e-6;
            CheckedSoup checked = check_soup(cracked, options);
            EXPECT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
            EXPECT_EQ(checked.soup.vertices.size(), shape.vertices.size());
            EXPECT_EQ(checked.ladder.done_by(RepairKind::merge),
                      static_cast<std::int64_t>(cracked.vertices.size() - shape.vertices.size()));
            apply_repairs(checked);
            EXPECT_NEAR(enclosed_volume(checked.soup.vertices, checked.soup.facets) /
                            enclosed_volume(shape.vertices, shape.facets),
                        1, 1e-6);
        }
}

TEST(SpannedHoles, CloseEverySmallHole) {
    for (const Soup& shape : whole_shapes())
        for (unsigned seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            const Soup open = with_holes(shape, seed);
            const std::vector<OpenLoop> loops = find_open_loops(open.vertices, open.facets);
            ASSERT_FALSE(loops.empty());
            InputOptions options;
            options.repairs.fill_hole_edges = 100;
            CheckedSoup checked = check_soup(open, options);
            EXPECT_EQ(checked.ladder.done_by(RepairKind::span), static_cast<std::int64_t>(loops.size()));
            std::int64_t facets = 0;
            for (const OpenLoop& loop : loops) facets += static_cast<std::int64_t>(loop.vertices.size()) - 2;
            EXPECT_EQ(checked.ladder.preparation(RepairKind::span).added_facets, facets);
            ASSERT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
            EXPECT_EQ(checked.diagnosis.count(DefectKind::inconsistent_orientation), 0);
            EXPECT_EQ(checked.soup.patch_names.back(), "filled");
            EXPECT_EQ(std::count(checked.soup.patch.begin(), checked.soup.patch.end(),
                                 static_cast<std::int32_t>(checked.soup.patch_names.size()) - 1),
                      facets);
            const Soup filled = checked.soup;
            EXPECT_TRUE(std::equal(open.facets.begin(), open.facets.end(), filled.facets.begin()));
            apply_repairs(checked);
            EXPECT_NEAR(enclosed_volume(checked.soup.vertices, checked.soup.facets) /
                            enclosed_volume(shape.vertices, shape.facets),
                        1, 0.15);
        }
}

TEST(SpannedHoles, LeaveLoopsOfMoreEdges) {
    Soup soup = test::icosphere(2);
    const Numbers fan = test::facets_with(soup, {5});
    std::vector<char> drop(soup.facets.size(), 0);
    for (const std::int32_t f : fan) drop[f] = 1;
    const std::int32_t alone = 200;
    ASSERT_EQ(drop[alone], 0);
    drop[alone] = 1;
    drop_facets(soup, drop);
    drop_unused_vertices(soup);
    const auto rim = static_cast<std::int32_t>(fan.size());
    const auto spanned = [](Soup& open, std::int32_t most_edges) {
        RepairPlan plan;
        plan.put({RepairKind::span, Length(most_edges)});
        return repair(open, plan).done_by(RepairKind::span);
    };
    Soup small = soup, none = soup;
    EXPECT_EQ(spanned(none, 2), 0);
    EXPECT_EQ(none.facets, soup.facets);
    EXPECT_EQ(none.patch_names, soup.patch_names);
    EXPECT_EQ(spanned(small, rim - 1), 1);
    EXPECT_EQ(find_open_loops(small.vertices, small.facets).size(), 1u);
    EXPECT_EQ(spanned(soup, rim), 2);
    EXPECT_TRUE(find_open_loops(soup.vertices, soup.facets).empty());
}

TEST(FeaturePatches, AreTheSidesOfABoxTheFacesOfAPrismAndOneSphere) {
    struct Case {
        Soup soup;
        double angle_deg;
        std::int32_t patches;
    };
    const std::vector<Case> cases = {{box(Vec3::Zero(), Vec3(1, 2, 3), 4), 40, 6},
                                     {box(Vec3::Zero(), Vec3(1, 2, 3), 4), 91, 1},
                                     {test::icosphere(3), 40, 1},
                                     {test::prism(24, 1, 3), 40, 3},
                                     {test::prism(24, 1, 3), 10, 26},
                                     {test::nested_boxes(2, 2), 40, 12},
                                     {test::block_with_cavities({2, 1, 1}), 60, 8}};
    for (const Case& c : cases) {
        Soup soup = c.soup;
        EXPECT_EQ(make_feature_patches(soup, c.angle_deg), c.patches) << c.soup.patch_names[0] << ' ' << c.angle_deg;
        ASSERT_EQ(soup.patch_names.size(), static_cast<std::size_t>(c.patches));
        EXPECT_EQ(soup.patch_names.back(), "face_" + std::to_string(c.patches));
        std::int32_t next = 0;
        for (const std::int32_t patch : soup.patch) {  // numbered by first facet
            EXPECT_LE(patch, next);
            next = std::max(next, patch + 1);
        }
        EXPECT_EQ(next, c.patches);
    }
    Soup sides = box(Vec3::Zero(), Vec3(1, 2, 3), 4);
    const Numbers patch = sides.patch;
    make_feature_patches(sides, 40);
    EXPECT_EQ(sides.patch, patch) << "each side of the box is a patch already";
}

TEST(KeepLargestComponent, KeepsWhatHangsTogetherOverVertices) {
    const Soup large = box(Vec3::Zero(), Vec3::Constant(3)), small = test::icosphere(2);
    for (const bool first : {false, true}) {
        const Soup aside = translated(small, Vec3(9, 9, 9));
        Soup soup = first ? join(large, aside) : join(aside, large);
        EXPECT_EQ(keep_largest_component(soup), 320) << "area counts, not the number of facets";
        EXPECT_EQ(drop_unused_vertices(soup), 162);
        EXPECT_EQ(soup.vertices, large.vertices);
        EXPECT_EQ(soup.facets, large.facets);
        EXPECT_EQ(soup.file_facets({0}), Numbers{first ? 0 : 320});
    }
    Soup touching = join(box(), box(Vec3(1, 1, 1), Vec3(2, 2, 2)));
    weld_exactly(touching);
    EXPECT_EQ(keep_largest_component(touching), 0) << "one vertex is enough";
}

}  // namespace
}  // namespace kerf
