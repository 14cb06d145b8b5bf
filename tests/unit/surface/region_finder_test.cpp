// The oracle: cubes with labels, whose sides are known.
#include "surface/regions/region_finder.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/geometry/union_find.h"
#include "support/shapes.h"
#include "support/voxel_regions.h"
#include "surface/complex/complex.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

using Place = std::array<std::int32_t, 3>;

Soup soup_of(const test::VoxelBody& body) {
    Soup soup;
    soup.vertices = body.facets.vertices;
    soup.facets = body.facets.facets;
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"all"};
    return soup;
}

Complex complex_of(const Soup& soup) {
    SurfaceArrays arrays = test::to_arrays(soup);
    return {arrays, soup.sides, soup.region_names};
}

std::map<std::string, double> volumes_of(const Soup& soup) {
    const Complex complex = complex_of(soup);
    std::map<std::string, double> volumes;
    for (const RegionIndex r : ids<RegionIndex>(complex.region_count())) {
        const SurfaceArrays own = complex.arrays_of(r);
        volumes[soup.region_names[r.value()]] = enclosed_volume(own.vertices, own.facets);
    }
    return volumes;
}

// Cubes as bodies: all facets of each label, outwards, so that walls are there twice.
Soup doubled(const test::VoxelBody& body, bool has_patches, unsigned seed) {
    std::mt19937 random(seed);
    Soup soup;
    soup.vertices = body.facets.vertices;
    std::vector<std::pair<Triangle, RegionIndex>> facets;
    for (std::size_t f = 0; f < body.sides.size(); ++f) {
        const Triangle& t = body.facets.facets[f];
        facets.emplace_back(t, body.sides[f].back);
        if (body.sides[f].is_wall()) facets.emplace_back(Triangle{t[1], t[0], t[2]}, body.sides[f].front);
    }
    std::shuffle(facets.begin(), facets.end(), random);
    for (const auto& [t, region] : facets) {
        soup.facets.push_back(t);
        soup.patch.push_back(has_patches ? region.value() : 0);
    }
    soup.patch_names = has_patches ? body.names : std::vector<std::string>{"all"};
    return soup;
}

std::map<std::string, double> volumes_of(const test::VoxelBody& body) {
    std::map<std::string, double> volumes;
    for (std::size_t r = 0; r < body.names.size(); ++r) volumes[body.names[r]] = body.volumes[r];
    return volumes;
}

TEST(TouchingBodies, OfPatchesAreTheRegions) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const test::VoxelBody body = test::voxel_body({6, 5, 4}, test::grains({6, 5, 4}, 7, seed));
        Soup soup = doubled(body, true, seed);
        if (seed % 2)
            for (Triangle& t : soup.facets) std::swap(t[0], t[1]);  // all inside out
        ASSERT_TRUE(find_touching_bodies(soup));
        EXPECT_EQ(soup.facets.size(), body.sides.size());
        EXPECT_EQ(soup.region_names, body.names);
        EXPECT_EQ(volumes_of(soup), volumes_of(body));
    }
}

TEST(TouchingBodies, WithoutPatchesAreCells) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const auto grain = test::grains({6, 5, 4}, 7, seed);
        const test::VoxelBody body =
            test::voxel_body({6, 5, 4}, [&](Place c) { return grain(c) == 3 ? -1 : grain(c); });
        Soup soup = doubled(body, false, seed);
        ASSERT_TRUE(find_touching_bodies(soup));
        EXPECT_EQ(soup.facets.size(), body.sides.size());
        double volume = 0, wanted = 0;
        for (const auto& [name, own] : volumes_of(soup)) volume += own;
        for (const double own : body.volumes) wanted += own;
        EXPECT_EQ(volume, wanted);
        EXPECT_EQ(soup.region_names[0], "region_1");
    }
}

TEST(TouchingBodies, OfWallsThatAreThereOnceAreAllCells) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const test::VoxelBody body = test::voxel_body({6, 5, 4}, test::grains({6, 5, 4}, 5, seed));
        Soup soup = soup_of(body);
        std::mt19937 random(seed);
        for (Triangle& t : soup.facets)
            if (random() % 2) std::swap(t[0], t[1]);
        ASSERT_TRUE(find_touching_bodies(soup));
        EXPECT_EQ(soup.facets.size(), body.sides.size());
        double volume = 0;
        for (const auto& [name, own] : volumes_of(soup)) volume += own;
        EXPECT_EQ(volume, 120);
        ASSERT_EQ(soup.notes.size(), 1U);
        EXPECT_NE(soup.notes[0].find("--region"), std::string::npos);
    }
}

TEST(TouchingBodies, TheInnermostOfSeveralIsTheSmallest) {
    Soup soup = test::join(test::box(Vec3(0, 0, 0), Vec3(4, 4, 4), 4), test::box(Vec3(1, 1, 0), Vec3(3, 3, 2), 2));
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f >= 12 * 16;
    soup.patch_names = {"bone", "cement"};
    weld_exactly(soup);
    ASSERT_TRUE(find_touching_bodies(soup));
    EXPECT_EQ(volumes_of(soup), (std::map<std::string, double>{{"bone", 56}, {"cement", 8}}));
}

// None of them may vanish.
TEST(TouchingBodies, AreNotFoundWhereOthersHideOne) {
    Soup soup = test::join(test::box(), test::box());
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = 2 * f < soup.facets.size() ? 0 : 1;
    soup.patch_names = {"first", "copy"};
    weld_exactly(soup);
    EXPECT_FALSE(find_touching_bodies(soup));
    EXPECT_FALSE(find_given_bodies(soup, {0, 1}, {"first", "copy"}));
    EXPECT_TRUE(soup.sides.empty() && soup.region_names.empty());
}

TEST(TouchingBodies, AreNotFoundInOneBody) {
    for (Soup soup : {test::box(), test::icosphere(2), test::nested_boxes(3, 2), test::torus(3, 1, 12, 7)}) {
        const Soup before = soup;
        EXPECT_FALSE(find_touching_bodies(soup));
        EXPECT_EQ(soup.facets, before.facets);
        EXPECT_TRUE(soup.sides.empty() && soup.notes.empty());
        soup.facets.push_back(soup.facets[3]);
        soup.patch.push_back(0);
        EXPECT_FALSE(find_touching_bodies(soup));
    }
}

// A block with a void, and a cube that touches it along an edge.
TEST(TouchingBodies, AreNotFoundInOneThatTouchesItself) {
    const auto region = [](Place c) {
        const bool is_block = c[0] < 3 && c != Place{1, 1, 1}, is_beside = c == Place{3, 3, 0};
        return is_block || is_beside ? 0 : -1;
    };
    Soup soup = soup_of(test::voxel_body({4, 4, 3}, [&](Place c) { return c[1] < 3 || c[0] == 3 ? region(c) : -1; }));
    EXPECT_FALSE(find_touching_bodies(soup));
    EXPECT_TRUE(soup.sides.empty());
}

// A box of 2 x 1 x 1 with a wall in the middle.
Soup two_rooms() {
    return soup_of(test::voxel_body({2, 1, 1}, [](Place c) { return c[0]; }));
}

std::string refusal_of(Soup soup) {
    try {
        find_seeded_regions(soup);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return "";
}

TEST(SeededRegions, HaveTheNamesOfTheirPoints) {
    Soup soup = two_rooms();
    soup.seeds = {{"right", Vec3(1.5, 0.5, 0.5)}, {"left", Vec3(0.5, 0.25, 0.5)}};
    ASSERT_TRUE(find_seeded_regions(soup));
    EXPECT_EQ(soup.region_names, (std::vector<std::string>{"right", "left"}));
    EXPECT_EQ(volumes_of(soup), (std::map<std::string, double>{{"left", 1}, {"right", 1}}));
    EXPECT_TRUE(soup.notes.empty());
}

TEST(SeededRegions, CellsWithoutAPointAreNamedAndNoted) {
    Soup soup = two_rooms();
    soup.seeds = {{"cell_1", Vec3(1.5, 0.5, 0.5)}};
    ASSERT_TRUE(find_seeded_regions(soup));
    EXPECT_EQ(soup.region_names, (std::vector<std::string>{"cell_1", "cell_2"}));
    EXPECT_EQ(soup.notes, (std::vector<std::string>{"1 cell is without a point of a region: cell_2."}));
}

TEST(SeededRegions, CellsOfOneNameAreOneRegion) {
    Soup soup = two_rooms();
    soup.seeds = {{"both", Vec3(1.5, 0.5, 0.5)}, {"both", Vec3(0.5, 0.5, 0.25)}};
    ASSERT_TRUE(find_seeded_regions(soup));
    EXPECT_TRUE(soup.sides.empty());
    EXPECT_EQ(soup.facets.size(), 20U);
    EXPECT_EQ(soup.notes, (std::vector<std::string>{"2 facets with the same on both sides are left out."}));
    EXPECT_EQ(enclosed_volume(soup.vertices, soup.facets), 2);
}

TEST(SeededRegions, CellsOfHolesAreEmpty) {
    Soup soup = two_rooms();
    soup.seeds = {{"left", Vec3(0.5, 0.5, 0.25)}};
    soup.holes = {Vec3(1.5, 0.5, 0.25)};
    ASSERT_TRUE(find_seeded_regions(soup));
    EXPECT_TRUE(soup.sides.empty());
    EXPECT_EQ(enclosed_volume(soup.vertices, soup.facets), 1);
}

TEST(SeededRegions, RefuseMisplacedPoints) {
    Soup soup = two_rooms();
    soup.seeds = {{"a", Vec3(0.25, 0.5, 0.5)}, {"b", Vec3(0.5, 0.5, 0.25)}};
    const std::string two = refusal_of(soup);
    for (const char* part : {"'a'", "'b'", "(0.25, 0.5, 0.5)", "(0.5, 0.5, 0.25)"})
        EXPECT_NE(two.find(part), std::string::npos) << two;
    soup.seeds = {{"a", Vec3(3, 0.5, 0.5)}};
    EXPECT_NE(refusal_of(soup).find("lies outside"), std::string::npos);
    soup.seeds = {{"a", Vec3(1, 0.5, 0.25)}};
    EXPECT_NE(refusal_of(soup).find("lies on a facet"), std::string::npos);
    soup.seeds = {{"a", Vec3(0.25, 0.5, 0.5)}};
    soup.holes = {Vec3(0.5, 0.5, 0.5)};
    EXPECT_NE(refusal_of(soup).find("of a hole"), std::string::npos);
}

TEST(SeededRegions, OfGrainsAreAllOfThem) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Place cubes = {6, 5, 4};
        const auto grain = test::grains(cubes, 6, seed);
        const auto region = [&](Place c) { return grain(c) % 4 - (seed % 3 == 0); };
        const test::VoxelBody body = test::voxel_body(cubes, region);
        std::set<std::int32_t> labels;
        for (std::int32_t x = 0; x < 6; ++x)
            for (std::int32_t y = 0; y < 5; ++y)
                for (std::int32_t z = 0; z < 4; ++z) labels.insert(region({x, y, z}));
        labels.erase(-1);
        Soup soup = soup_of(body);
        for (std::int32_t x = 0; x < 6; ++x)  // a point for each cube; those without a label are holes
            for (std::int32_t y = 0; y < 5; ++y)
                for (std::int32_t z = 0; z < 4; ++z) {
                    const std::int32_t own = region({x, y, z});
                    const Vec3 p(x + 0.5, y + 0.375, z + 0.25);
                    if (own < 0)
                        soup.holes.push_back(p);
                    else
                        soup.seeds.push_back({body.names[std::distance(labels.begin(), labels.find(own))], p});
                }
        if (labels.size() < 2) continue;
        ASSERT_TRUE(find_seeded_regions(soup));
        EXPECT_EQ(soup.facets.size(), body.sides.size());
        EXPECT_EQ(volumes_of(soup), volumes_of(body));
    }
}

TEST(FillVoids, MakesTheInsideOfAVoidARegion) {
    Soup two = test::nested_boxes(2), three = test::nested_boxes(3, 2);
    ASSERT_TRUE(fill_voids(two) && fill_voids(three));
    EXPECT_EQ(volumes_of(two), (std::map<std::string, double>{{"body", 26}, {"void_1", 1}}));
    EXPECT_EQ(volumes_of(three), (std::map<std::string, double>{{"body_1", 1}, {"body_2", 98}, {"void_1", 26}}));
    Soup box = test::box();
    EXPECT_FALSE(fill_voids(box));
    EXPECT_TRUE(box.sides.empty());
}

TEST(FillVoids, OfRegionsHaveNumbersBehindTheirs) {
    const auto region = [](Place c) { return c == Place{1, 1, 1} ? -1 : c[0] > 0; };
    const test::VoxelBody body = test::voxel_body({3, 3, 3}, region);
    Soup soup = soup_of(body);
    soup.sides = body.sides;
    soup.region_names = body.names;
    ASSERT_TRUE(fill_voids(soup));
    EXPECT_EQ(soup.region_names, (std::vector<std::string>{"region_0", "region_1", "void_1"}));
    EXPECT_EQ(volumes_of(soup).at("void_1"), 1);
}

TEST(RegionFinder, EmptyRegionsLeaveHolesInTheOthers) {
    Soup soup = test::join(test::box(Vec3::Zero(), Vec3(4, 4, 4), 2), test::box(Vec3(1, 1, 1), Vec3(3, 3, 3), 1));
    soup.patch_names = {"shell", "core"};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f < 48 ? 0 : 1;
    ASSERT_TRUE(find_given_bodies(soup, {0, 1}, {"shell", "core"}));
    ASSERT_EQ(volumes_of(soup), (std::map<std::string, double>{{"core", 8}, {"shell", 56}}));
    Soup hollow = soup;
    leave_regions_empty(hollow, {"c*"});
    EXPECT_TRUE(hollow.sides.empty()) << "a single region needs none";
    EXPECT_EQ(enclosed_volume(hollow.vertices, hollow.facets), 56);
    EXPECT_EQ(hollow.patch_names, (std::vector<std::string>{"shell_outer", "core"}));
    Soup core = soup;
    leave_regions_empty(core, {"shell"});
    EXPECT_EQ(enclosed_volume(core.vertices, core.facets), 8);
    EXPECT_THROW(leave_regions_empty(soup, {"*"}), Error) << "nothing is left";
    EXPECT_THROW(leave_regions_empty(soup, {"bone"}), Error);
}

}  // namespace
}  // namespace kerf
