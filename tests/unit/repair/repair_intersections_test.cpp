// The oracle: boxes between whole numbers, so that what they enclose is counted in unit cubes. Their sides lie in
// common planes, on common lines and on each other more often than not.
#include <algorithm>
#include <array>
#include <span>

#include <gtest/gtest.h>

#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/intersections.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {
namespace {

constexpr int edge = 6;

struct WholeBox {
    std::array<int, 3> low, high;

    bool contains(const std::array<int, 3>& cube) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (cube[i] < low[i] || cube[i] >= high[i]) return false;
        return true;
    }
    double volume() const { return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]); }
    Soup soup() const { return test::box(Vec3(low[0], low[1], low[2]), Vec3(high[0], high[1], high[2])); }
};

std::vector<WholeBox> random_boxes(int count, test::SeededNumbers& random) {
    std::vector<WholeBox> boxes(count);
    for (WholeBox& box : boxes)
        for (std::size_t i = 0; i < 3; ++i) {
            box.low[i] = random.integer(0, edge - 1);
            box.high[i] = random.integer(box.low[i] + 1, edge);
        }
    return boxes;
}

template <class Visit>
void for_each_cube(Visit visit) {
    for (int x = 0; x < edge; ++x)
        for (int y = 0; y < edge; ++y)
            for (int z = 0; z < edge; ++z) visit(std::array{x, y, z});
}

double count_within_any(const std::vector<WholeBox>& boxes) {
    double count = 0;
    for_each_cube([&](const std::array<int, 3>& cube) {
        count += std::any_of(boxes.begin(), boxes.end(), [&](const WholeBox& box) { return box.contains(cube); });
    });
    return count;
}

// A patch for each, all edges of one length in the mean so that facets are pieces of others.
Soup soup_of(const std::vector<WholeBox>& boxes) {
    Soup soup;
    for (const WholeBox& box : boxes) {
        Soup own = box.soup();
        own.patch.assign(own.facets.size(), 0);
        own.patch_names = {"box"};
        soup = test::join(std::move(soup), own);
    }
    for (std::size_t p = 0; p < soup.patch_names.size(); ++p) soup.patch_names[p] += "_" + std::to_string(p);
    weld_exactly(soup);
    return soup;
}

StepReport resolve(Soup& soup, BodyRepair bodies = BodyRepair::unite) {
    StepRequest request;
    request.bodies = bodies;
    StepReport report{RepairKind::intersections, {}};
    intersections_step(soup, request, report);
    return report;
}

std::int64_t count_of(const StepReport& report, const std::string& what) {
    std::int64_t count = 0;
    for (const RepairAction& action : report.actions)
        if (what == action.one) count += action.count;
    return count;
}

// Each edge as often in one direction as in the other.
bool closes(const std::vector<Triangle>& facets) {
    bool does = true;
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        int sum = 0;
        for (const auto& c : corners) sum += start_vertex(facets, c.corner) == low ? 1 : -1;
        does &= sum == 0;
    });
    return does;
}

std::int64_t count_open(const std::vector<Triangle>& facets) {
    std::int64_t count = 0;
    EdgeCorners(facets).for_each_edge([&](std::int32_t, auto corners) { count += corners.size() == 1; });
    return count;
}

void expect_proper(const Soup& soup) {
    EXPECT_TRUE(closes(soup.facets));
    EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
    EXPECT_TRUE(std::is_sorted(soup.polygon.begin(), soup.polygon.end()));
    EXPECT_EQ(soup.patch.size(), soup.facets.size());
}

TEST(Intersections, OfBoxesGiveTheirUnion) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        const std::vector<WholeBox> boxes = random_boxes(1 + static_cast<int>(seed % 6), random);
        Soup soup = soup_of(boxes);
        resolve(soup);
        expect_proper(soup);
        EXPECT_NEAR(enclosed_volume(soup.vertices, soup.facets), count_within_any(boxes), 1e-9);
    }
}

TEST(Intersections, OfBoxesInAnyPlaceGiveTheirUnion) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        const Vec3 shift(random.between(-0.99, 0.99), random.between(-0.99, 0.99), random.between(-0.99, 0.99));
        Soup soup = test::join(test::box(Vec3::Zero(), Vec3::Ones(), 2),
                               test::translated(test::box(Vec3::Zero(), Vec3::Ones(), 3), shift));
        const StepReport report = resolve(soup);
        expect_proper(soup);
        EXPECT_NEAR(enclosed_volume(soup.vertices, soup.facets), 2 - (1 - shift.array().abs()).prod(), 1e-12);
        EXPECT_GT(count_of(report, "crossing resolved"), 0);
        EXPECT_EQ(count_of(report, "inner piece left out"), 1);
    }
}

TEST(Intersections, GiveRegionsTheSmallerBodyFirst) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        const Vec3 low(random.between(-0.7, 0.9), random.between(-0.7, 0.9), random.between(-0.7, 0.9));
        const Soup small = test::box(low, low + Vec3::Constant(0.8), 2);
        Soup soup = test::join(test::box(), small);
        weld_exactly(soup);
        for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = soup.patch[f] >= 6;
        soup.patch_names = {"large", "small"};
        resolve(soup, BodyRepair::regions);
        ASSERT_EQ(soup.region_names, (std::vector<std::string>{"large", "small"}));
        EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
        const Vec3 common = (low + Vec3::Constant(0.8)).cwiseMin(1) - low.cwiseMax(0);
        for (const RegionIndex r : ids<RegionIndex>(2)) {
            std::vector<Triangle> own;
            for (std::size_t f = 0; f < soup.facets.size(); ++f) {
                const auto [a, b, c] = soup.facets[f];
                if (soup.sides[f].back == r) own.push_back({a, b, c});
                if (soup.sides[f].front == r) own.push_back({a, c, b});
            }
            EXPECT_TRUE(closes(own));
            EXPECT_NEAR(enclosed_volume(soup.vertices, own),
                        r == RegionIndex(1) ? 0.512 : 1 - common.cwiseMax(0).prod(), 1e-12);
        }
    }
}

TEST(Intersections, OfWholeBoxesGiveRegionsTheSmallerBodyFirst) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        const std::vector<WholeBox> boxes = random_boxes(2 + static_cast<int>(seed % 4), random);
        std::vector<double> expected(boxes.size(), 0);
        for_each_cube([&](const std::array<int, 3>& cube) {
            std::size_t smallest = boxes.size();
            for (std::size_t b = 0; b < boxes.size(); ++b)
                if (boxes[b].contains(cube) &&
                    (smallest == boxes.size() || boxes[b].volume() < boxes[smallest].volume()))
                    smallest = b;
            if (smallest < boxes.size()) ++expected[smallest];
        });
        std::erase(expected, 0);
        Soup soup = soup_of(boxes);
        resolve(soup, BodyRepair::regions);
        if (expected.size() == 1) {
            EXPECT_TRUE(soup.sides.empty());
            EXPECT_NEAR(enclosed_volume(soup.vertices, soup.facets), expected[0], 1e-9);
            continue;
        }
        ASSERT_EQ(soup.region_names.size(), expected.size());
        EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
        for (std::size_t r = 0; r < expected.size(); ++r) {
            std::vector<Triangle> own;
            for (std::size_t f = 0; f < soup.facets.size(); ++f) {
                const auto [a, b, c] = soup.facets[f];
                if (soup.sides[f].back == RegionIndex(r)) own.push_back({a, b, c});
                if (soup.sides[f].front == RegionIndex(r)) own.push_back({a, c, b});
            }
            EXPECT_TRUE(closes(own));
            EXPECT_NEAR(enclosed_volume(soup.vertices, own), expected[r], 1e-9);
        }
    }
}

TEST(Intersections, LeaveCleanSurfacesAsTheyAre) {
    const Soup hollow = test::join(test::icosphere(3, 2), test::inside_out(test::icosphere(2, 1)));
    const Soup apart = test::join(test::icosphere(2), test::translated(test::box(), Vec3(3, 0, 0)));
    for (const Soup& clean :
         {test::torus(3, 1, 30, 20), hollow, apart, test::inside_out(test::box()), test::plate_with_hole(24)}) {
        Soup soup = clean;
        EXPECT_FALSE(resolve(soup).changed());
        EXPECT_EQ(soup.vertices, clean.vertices);
        EXPECT_EQ(soup.facets, clean.facets);
        EXPECT_EQ(soup.polygon, clean.polygon);
        EXPECT_EQ(soup.vertex_number, clean.vertex_number);
    }
}

TEST(Intersections, KeepWhatCrossesNothing) {
    const Soup far = test::translated(test::icosphere(2), Vec3(0, 0, 9));
    Soup soup = test::join(test::join(far, test::box()), test::translated(test::box(), Vec3(0.5, 0.4, 0.3)));
    const Soup before = soup;
    resolve(soup);
    ASSERT_GT(soup.facets.size(), far.facets.size());
    for (std::size_t f = 0; f < far.facets.size(); ++f) {
        EXPECT_EQ(soup.polygon[f], static_cast<std::int32_t>(f));
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(soup.vertices[soup.facets[f][i]], before.vertices[before.facets[f][i]]);
    }
}

TEST(Intersections, AreRefusedWhereDoublesAreCoarserThanMostFacets) {
    test::SeededNumbers random(11);
    for (const double far : {1e3, 1e9, 1e17, 1e25, 1e38}) {
        Soup soup = soup_of(random_boxes(3, random));
        Soup needle;
        needle.vertices = {Vec3(0.5, 0.5, -1), Vec3(0.25, far, far / 2), Vec3(-far / 3, 0.5, 1)};
        needle.facets = {{0, 1, 2}};
        needle.patch = {0};
        needle.patch_names = {"needle"};
        soup = test::join(std::move(soup), needle);
        const auto vertices = soup.vertices;
        const auto facets = soup.facets;
        const StepReport report = resolve(soup);
        const auto refused = std::find_if(report.actions.begin(), report.actions.end(), [](const RepairAction& action) {
            return action.one == std::string("surface") && !action.places.empty();
        });
        EXPECT_EQ(refused != report.actions.end(), far > 1e16) << far;
        if (refused == report.actions.end()) continue;
        ASSERT_EQ(refused->places.size(), 1u);
        EXPECT_EQ(refused->places[0].where, needle.vertices[1]);
        EXPECT_EQ(refused->places[0].facets, std::vector<std::int32_t>{static_cast<std::int32_t>(facets.size()) - 1});
        EXPECT_STRNE(refused->refused_because, "");
        EXPECT_FALSE(report.changed());
        EXPECT_EQ(soup.vertices, vertices);
        EXPECT_EQ(soup.facets, facets);
    }
}

TEST(Intersections, TellShellsInsideOfOthers) {
    Soup soup = test::join(test::icosphere(3, 2), test::icosphere(2, 1));
    const StepReport report = resolve(soup);
    EXPECT_EQ(count_of(report, "shell inside of another left out"), 1);
    EXPECT_EQ(std::ssize(soup.facets), 20 * 64);
}

TEST(Intersections, OpenNothingBesideHolesThatAreLeft) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        Soup soup = test::join(test::icosphere(3), test::translated(test::icosphere(3), Vec3(0.9, 0.3, 0.2)));
        std::erase_if(soup.facets, [&](const Triangle&) { return random.with_chance(0.02); });
        soup.patch.resize(soup.facets.size());
        const std::int64_t open = count_open(soup.facets);
        resolve(soup);
        EXPECT_LE(count_open(soup.facets), open + open / 4);
        EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
    }
}

TEST(Intersections, SayThatOpenSurfacesBoundNothing) {
    Soup sheet = test::box(Vec3::Zero(), Vec3::Ones(), 4);
    std::erase_if(sheet.facets, [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return sheet.vertices[v].z() > 0; });
    });
    sheet.patch.resize(sheet.facets.size());
    Soup other = test::translated(sheet, Vec3(0.1, 0.2, 0));
    for (Vec3& p : other.vertices) p.z() = p.x() - 0.6;
    sheet = test::join(sheet, other);
    Soup soup = sheet;
    const StepReport report = resolve(soup);
    EXPECT_FALSE(report.changed());
    EXPECT_EQ(count_of(report, "surface"), 1);
    EXPECT_EQ(soup.facets, sheet.facets);
}

}  // namespace
}  // namespace kerf
