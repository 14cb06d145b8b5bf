// Whatever happens to less than a hundredth of a body, the whole ladder of repairs makes a surface of it that can be
// meshed, with the volume that the body had, and no vertex farther from its place than is said. More seeds, and those
// of a finding: KERF_DAMAGES=FIRST:COUNT repair_test.
#include <cstdlib>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/geometry/box.h"
#include "files/io/surface_reader.h"
#include "run/prepare/input.h"
#include "support/assets.h"
#include "support/random_damage.h"
#include "support/region_bodies.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "surface/complex/mass_properties.h"
#include "surface/repair/repair.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {
namespace {

constexpr int damages = 300, groups = 6;

const Soup& whole_asset(const std::string& name) {
    static std::map<std::string, Soup> assets;
    Soup& soup = assets[name];
    if (soup.facets.empty()) {
        soup = read_surface(test::asset_path(name));
        weld_exactly(soup);
        soup.vertex_number.clear();
        soup.polygon.clear();
    }
    return soup;
}

// Mostly small ones, each of the others now and then.
std::string asset_of(int damage) {
    static const char* const small[] = {"cube", "cylinder", "hollow_box", "bone"};
    static const char* const others[] = {"knee_tibial",     "pipe_with_holes", "wing_in_box",
                                         "bearing_cap_14k", "knee_femoral",    "sinter_packing"};
    return damage % 12 == 11 ? others[damage / 12 % 6] : small[damage % 4];
}

// One kind of damage, or several of any kind.
test::DamagedBody damaged_body(int damage) {
    const Soup& whole = whole_asset(asset_of(damage));
    const auto seed = static_cast<std::uint64_t>(damage);
    test::DamagedBody body(whole, seed);
    const double gap = 5e-4 * box_around_finite(whole.vertices).diagonal().norm();
    const auto kinds = test::all_surface_damages;
    body.suffer(kinds[seed % kinds.size()], gap);
    test::SeededNumbers numbers(seed);
    if (damage % 3 == 0)
        for (int more = numbers.integer(1, 4); more > 0; --more)
            body.suffer(kinds[static_cast<std::size_t>(numbers.integer(0, kinds.size() - 1))], gap);
    return body;
}

CheckedSoup check_repaired(const Soup& damaged) {
    InputOptions options;
    options.repairs.plan = "full";
    return check_soup(damaged, options, 0.1);
}

// Of corners of facets of the file; of what was added only that it is somewhere near is known.
double farthest_corner(const Soup& repaired, const Soup& damaged) {
    std::vector<Triangle> facets;
    for (const Triangle& t : damaged.facets)
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) facets.push_back(t);
    const TriangleTree tree(damaged.vertices, facets);
    double farthest = 0;
    for (std::size_t f = 0; f < repaired.facets.size(); ++f)
        if (repaired.patch[f] < static_cast<std::int32_t>(damaged.patch_names.size()))
            for (const std::int32_t v : repaired.facets[f])
                farthest = std::max(farthest, tree.closest(repaired.vertices[v]).squared_distance);
    return std::sqrt(farthest);
}

void expect_repaired(int damage) {
    const test::DamagedBody body = damaged_body(damage);
    SCOPED_TRACE(fmt::format("KERF_DAMAGES={}:1, {}, {}", damage, asset_of(damage),
                             name(test::all_surface_damages[static_cast<std::size_t>(damage) % 7])));
    CheckedSoup checked = check_repaired(body.soup());
    if (!checked.diagnosis.clean()) {
        ADD_FAILURE() << checked.diagnosis.summary(checked.soup) << "\n" << to_text(checked.ladder);
        return;
    }
    apply_repairs(checked);
    const Soup& whole = whole_asset(asset_of(damage));
    const double volume = enclosed_volume(whole.vertices, whole.facets);
    EXPECT_NEAR(enclosed_volume(checked.soup.vertices, checked.soup.facets), volume, 1e-3 * volume)
        << to_text(checked.ladder);
    EXPECT_LE(checked.ladder.largest_move(), checked.ladder.bound);
    EXPECT_LE(farthest_corner(checked.soup, body.soup()), checked.ladder.bound * (1 + 1e-9)) << to_text(checked.ladder);
}

class RandomDamages : public testing::TestWithParam<int> {};

TEST_P(RandomDamages, AreRepairedWithinTheBoundAndToTheVolume) {
    int first = GetParam() * (damages / groups), count = test::in_slices() ? 5 : damages / groups;
    if (const char* asked = std::getenv("KERF_DAMAGES")) {
        if (GetParam() != 0) return;
        ASSERT_EQ(std::sscanf(asked, "%d:%d", &first, &count), 2) << "KERF_DAMAGES=FIRST:COUNT";
    }
    for (int damage = first; damage < first + count; ++damage) expect_repaired(damage);
}
INSTANTIATE_TEST_SUITE_P(Fifty, RandomDamages, testing::Range(0, groups));

// Of the unit cube and its copy, whose sides, of many facets, lie upon each other where it is shifted along axes.
TEST(ShiftedBodies, BecomeTheirUnion) {
    const Soup& cube = whole_asset("cube");
    for (const Vec3& shift :
         {Vec3(0.3, 0.41, -0.27), Vec3(0.5, 0, 0), Vec3(-0.2501, 0.3, 0), Vec3(0.01, 0.02, 0.005)}) {
        SCOPED_TRACE(fmt::format("shifted by ({}, {}, {})", shift.x(), shift.y(), shift.z()));
        Soup both = test::join(cube, test::translated(cube, shift));
        CheckedSoup checked = check_repaired(both);
        ASSERT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup) << "\n"
                                               << to_text(checked.ladder);
        apply_repairs(checked);
        const double common = (Vec3::Ones() - shift.cwiseAbs()).prod();
        EXPECT_NEAR(enclosed_volume(checked.soup.vertices, checked.soup.facets), 2 - common, 1e-9);
    }
}

// Walls of regions are facets within others: no level takes them out, whether bodies have them twice, walls are there
// once, or points say what they part. Only who asks for one body gets it.
TEST(Regions, KeepTheirWalls) {
    const Soup hollow = test::join(test::nested_boxes(1, 2), test::box(Vec3::Constant(-2), Vec3::Constant(2), 3));
    Soup once = test::fibres_in_block(1);
    once.sides.clear();
    once.region_names.clear();
    InputOptions plain, seeded;
    seeded.regions = {"core=0,0,0", "around=1.5,1.5,1.5"};
    struct Case {
        Soup soup;
        InputOptions options;
        std::size_t regions;
    };
    for (const auto& [soup, options, regions] : {Case{test::join(whole_asset("bone"), whole_asset("cement")), plain, 2},
                                                 Case{once, plain, 5}, Case{hollow, seeded, 2}})
        for (const char* level : {"exact", "near", "full"}) {
            InputOptions with = options;
            with.repairs.plan = level;
            const CheckedSoup whole = check_soup(soup, options, 0), repaired = check_soup(soup, with, 0);
            ASSERT_EQ(whole.soup.region_names.size(), regions);
            ASSERT_TRUE(repaired.diagnosis.clean()) << repaired.diagnosis.summary(repaired.soup);
            EXPECT_EQ(repaired.soup.region_names, whole.soup.region_names) << to_text(repaired.ladder);
            EXPECT_EQ(repaired.soup.facets, whole.soup.facets) << to_text(repaired.ladder);
            EXPECT_FALSE(repaired.ladder.changed()) << to_text(repaired.ladder);
        }
    plain.repairs.plan = "full,bodies=unite";
    const CheckedSoup one = check_soup(once, plain, 0);
    EXPECT_TRUE(one.diagnosis.clean());
    EXPECT_TRUE(one.soup.sides.empty());
    EXPECT_LT(one.soup.facets.size(), once.facets.size());
}

// Without one facet a wall parts nothing: that is told where it is, and mended, instead of leaving all of the wall out.
TEST(Regions, HaveADefectWhereAFacetOfAWallIsMissing) {
    Soup hollow = test::join(test::nested_boxes(1, 2), test::box(Vec3::Constant(-2), Vec3::Constant(2), 3));
    Soup once = test::fibres_in_block(1);
    InputOptions plain, seeded;
    seeded.regions = {"core=0,0,0", "around=1.5,1.5,1.5"};
    test::SeededNumbers random(56);
    const auto lacks = [](Soup soup, std::size_t f) {
        soup.sides.clear();
        soup.region_names.clear();
        soup.facets.erase(soup.facets.begin() + static_cast<std::ptrdiff_t>(f));
        soup.patch.erase(soup.patch.begin() + static_cast<std::ptrdiff_t>(f));
        return soup;
    };
    const auto expect_told_and_mended = [](const Soup& whole, const Soup& lacking, std::size_t f, InputOptions options,
                                           std::size_t regions) {
        const CheckedSoup checked = check_soup(lacking, options, 0);
        ASSERT_EQ(checked.diagnosis.count(DefectKind::open_edge), 1) << f;
        const auto open = std::find_if(checked.diagnosis.defects.begin(), checked.diagnosis.defects.end(),
                                       [](const Defect& defect) { return defect.kind == DefectKind::open_edge; });
        ASSERT_NE(open, checked.diagnosis.defects.end());
        EXPECT_EQ(open->vertices.size(), 3U);
        EXPECT_FALSE(checked.diagnosis.clean());
        options.repairs.plan = "full";
        const CheckedSoup repaired = check_soup(lacking, options, 0);
        const bool is_beside_others =
            !repaired.diagnosis.clean();  // at an edge of many: left, in words, with all facets
        if (is_beside_others) {
            EXPECT_EQ(repaired.soup.facets, lacking.facets) << f << "\n" << to_text(repaired.ladder);
            EXPECT_TRUE(options.regions.empty());
            return;
        }
        EXPECT_EQ(repaired.soup.region_names.size(), regions) << f << "\n" << to_text(repaired.ladder);
        EXPECT_EQ(repaired.soup.facets.size(), whole.facets.size()) << f;
    };
    for (int i = 0; i < 10; ++i) {
        const auto f = static_cast<std::size_t>(random.integer(0, 47));  // of the core
        expect_told_and_mended(hollow, lacks(hollow, f), f, seeded, 2);
    }
    for (std::size_t f = 0; f < once.facets.size(); ++f)
        if (once.sides[f].is_wall() && random.with_chance(0.05))
            expect_told_and_mended(once, lacks(once, f), f, plain, 5);
}

// An option and the word for the same step give the same surface, to the last bit; and preparations do to a surface
// what they do when it is mended afterwards, in a run of its own.
TEST(Spellings, OfOneStepGiveTheSameSurface) {
    const auto expect_same = [](const CheckedSoup& one, const CheckedSoup& other, int damage) {
        EXPECT_EQ(one.soup.vertices, other.soup.vertices) << damage;
        EXPECT_EQ(one.soup.facets, other.soup.facets) << damage;
        EXPECT_EQ(one.soup.patch, other.soup.patch) << damage;
        EXPECT_EQ(one.soup.patch_names, other.soup.patch_names) << damage;
        EXPECT_EQ(to_text(one.ladder), to_text(other.ladder)) << damage;
    };
    for (int damage = 0; damage < 24; ++damage) {
        const Soup body = damaged_body(damage).soup();
        InputOptions options, words, prepared, rest;
        options.repairs.plan = "near";
        options.repairs.cap = true;
        options.repairs.thicken = Length::percent(0.5);
        words.repairs.plan = "thicken=0.5%,near,caps";
        expect_same(check_soup(body, options, 0.1), check_soup(body, words, 0.1), damage);
        prepared.repairs.weld_tolerance = Length::percent(1e-3);
        prepared.repairs.keep_largest = true;
        prepared.repairs.fill_hole_edges = 12;
        rest.repairs.plan = "near";
        InputOptions both = prepared;
        both.repairs.plan = rest.repairs.plan;
        Soup first = body;
        weld_exactly(first);
        RepairReport report = repair(first, repair_plan_of(prepared));
        EXPECT_TRUE(report.steps.empty());
        EXPECT_EQ(report.preparations.size(), 3U);
        report = repair(first, repair_plan_of(rest));
        const CheckedSoup at_once = check_soup(body, both, 0.1);
        EXPECT_EQ(to_text(at_once.ladder), to_text(report)) << damage;
        drop_unused_vertices(first);
        EXPECT_EQ(at_once.soup.vertices, first.vertices) << damage;
        EXPECT_EQ(at_once.soup.facets, first.facets) << damage;
    }
}

TEST(WholeBodies, AreNotTouched) {
    for (const char* asset : {"cube", "hollow_box", "knee_tibial"}) {
        const Soup& whole = whole_asset(asset);
        Soup repaired = whole;
        const RepairReport report = repair(repaired, plan_of(RepairLevel::full));
        EXPECT_FALSE(report.changed()) << asset << "\n" << to_text(report);
        EXPECT_EQ(repaired.vertices, whole.vertices) << asset;
        EXPECT_EQ(repaired.facets, whole.facets) << asset;
        EXPECT_EQ(repaired.patch, whole.patch) << asset;
    }
}

}  // namespace
}  // namespace kerf
