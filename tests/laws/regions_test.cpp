// The laws of whole runs, for bodies of several regions that touch in every way.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/check.h"
#include "files/part/run_parts.h"
#include "files/part/second_order_parts.h"
#include "fill/mesh/edge_table.h"
#include "support/checked_run.h"
#include "support/region_bodies.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

using Cube = std::array<std::int32_t, 3>;

class SeveralRegions : public testing::TestWithParam<test::TouchingBodies> {};
INSTANTIATE_TEST_SUITE_P(Bodies, SeveralRegions, testing::ValuesIn(test::touching_bodies()),
                         [](const auto& param) { return param.param.name; });

void expect_laws(Input input, const Complex& complex, std::int32_t parts) {
    SCOPED_TRACE(testing::Message() << parts << " parts");
    const test::TemporaryFolder folder;
    const RunReport report = test::run_parts(std::move(input), folder.file("out"), parts);
    test::expect_verified(report, std::max(parts, complex.region_count()));
    EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), complex), "");
    const RunParts of_run(folder.file("out"));
    EXPECT_EQ(test::broken_sharing(of_run), "");
    EXPECT_EQ(test::broken_edge_nodes(SecondOrderParts(of_run, number_edges(of_run))), "");
}

TEST_P(SeveralRegions, ObeyEveryLawForAnyNumberOfParts) {
    constexpr std::int32_t fineness = 3;
    const Cube cubes = {fineness * GetParam().cubes[0], fineness * GetParam().cubes[1], fineness * GetParam().cubes[2]};
    const test::VoxelBody body = test::voxel_body(cubes, test::refined(GetParam().region, fineness));
    const auto regions = static_cast<std::int32_t>(body.names.size());
    for (const std::int32_t parts : {1, regions + 3, 4 * regions}) {
        Input input = make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
        for (std::size_t r = 0; r < body.volumes.size(); ++r)
            EXPECT_NEAR(input.regions[r].volume, body.volumes[r], 1e-9 * body.volumes[r]);
        expect_laws(std::move(input), test::to_complex(body), parts);
    }
}

// Regions around others, in others, through others, and such as end where others do.
TEST(RoundRegions, ObeyEveryLawForAnyNumberOfParts) {
    struct Case {
        const char* name;
        Soup body;
        double volume;  // of all regions
        std::vector<std::int32_t> parts;
    };
    for (const Case& c : {Case{"ball in a cube", test::ball_in_cube(1), 27, {2, 8, 64}},
                          Case{"linked rings in a box", test::linked_rings_in_box(1), 4.5 * 3.5 * 3.5, {3, 8}},
                          Case{"fibres in a block", test::fibres_in_block(1), 4 * 4 * 3, {5, 8}}}) {
        SCOPED_TRACE(c.name);
        for (const std::int32_t parts : c.parts) {
            Input input = make_input(c.body.vertices, c.body.facets, c.body.sides, c.body.region_names, c.body.patch,
                                     c.body.patch_names);
            EXPECT_NEAR(input.volume, c.volume, 1e-12 * c.volume);
            expect_laws(std::move(input), make_complex(c.body), parts);
        }
    }
}

TEST(RemeshedRegions, ObeyEveryLaw) {
    const test::VoxelBody body = test::voxel_body({6, 6, 6}, test::grains({6, 6, 6}, 7, 2));
    RunRequest options;
    options.remeshing = Remeshing::always;
    Input input = make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
    const test::TemporaryFolder folder;
    const RunReport report = test::run_parts(std::move(input), folder.file("out"), 10, options);
    test::expect_verified(report, 10);
    ASSERT_TRUE(report.input.remeshed);
    EXPECT_NE(report.input.complex.facet_count(), static_cast<std::int32_t>(body.facets.facets.size()));
    EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), report.input.complex), "");
    const RunParts of_run(folder.file("out"));
    EXPECT_EQ(test::broken_sharing(of_run), "");
    EXPECT_EQ(test::broken_edge_nodes(SecondOrderParts(of_run, number_edges(of_run))), "");
}

// A wall takes the smaller of the sizes on its sides, and both sides the same triangles.
TEST(SizesOfRegions, HoldInTheirRegionAndOnItsWalls) {
    const test::VoxelBody body = test::voxel_body({6, 3, 3}, test::refined([](Cube cube) { return cube[0]; }, 3));
    Input input = make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
    RunRequest options;
    options.sizes.size = 1.5;
    options.sizes.in_region = {"region_1=0.5"};
    const test::TemporaryFolder folder;
    const RunReport report = test::run_parts(std::move(input), folder.file("out"), 5, options);
    test::expect_verified(report, 5);
    const std::vector<Part> parts = test::read_parts(folder.file("out"));
    EXPECT_EQ(test::broken_laws(parts, report.input.complex), "");
    std::array<double, 2> longest = {0, 0}, tets = {0, 0};
    for (const Part& part : parts) {
        const auto region = static_cast<std::size_t>(part.region_of(0).value());
        tets[region] += static_cast<double>(part.tet_count());
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            for (std::size_t i = 0; i < 3 && (part.is_wall(f) || region == 1); ++i) {
                const Triangle& t = part.facets[f];
                longest[region] =
                    std::max(longest[region], (part.mesh.vertices[t[i]] - part.mesh.vertices[t[(i + 1) % 3]]).norm());
            }
    }
    EXPECT_LE(longest[0], 1.0) << "of the wall, where the other region's size is 0.5";
    EXPECT_LE(longest[1], 1.0);
    EXPECT_GT(tets[1], 3 * tets[0]);
    options.sizes.in_region = {"region_2=0.5"};
    Input again = make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
    EXPECT_THROW(test::run_parts(std::move(again), folder.file("again"), 5, options), Error);
}

// Of edges inside of a region, whose ends no other region and no surface has.
double median_edge_inside(const std::vector<Part>& parts, RegionIndex region) {
    std::vector<double> lengths;
    for (const Part& part : parts) {
        if (part.region_of(0) != region) continue;
        std::vector<char> is_outside(part.mesh.vertices.size(), 0);
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_of_input(f))
                for (const std::int32_t v : part.facets[f]) is_outside[v] = 1;
        for (const auto& tet : part.mesh.tets)
            for (const auto& [a, b] : tet_edges)
                if (!is_outside[tet[a]] && !is_outside[tet[b]])
                    lengths.push_back((part.mesh.vertices[tet[a]] - part.mesh.vertices[tet[b]]).norm());
    }
    KERF_CHECK(!lengths.empty());
    std::nth_element(lengths.begin(), lengths.begin() + std::ssize(lengths) / 2, lengths.end());
    return lengths[lengths.size() / 2];
}

// Cells of a region have its size, whether it is finer than the rest or coarser.
TEST(SizesOfRegions, HoldInsideOfTheRegion) {
    const test::VoxelBody body = test::voxel_body({2, 1, 1}, [](Cube cube) { return cube[0]; });
    for (const double size : {0.05, 0.1}) {
        SCOPED_TRACE(size);
        RunRequest options;
        const double of_the_other = 0.15 - size;
        options.sizes.size = of_the_other;
        options.sizes.in_region = {fmt::format("region_1={}", size)};
        for (const std::int32_t count : {2, 5}) {
            Input input =
                make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
            const test::TemporaryFolder folder;
            test::expect_verified(test::run_parts(std::move(input), folder.file("out"), count, options), count);
            const std::vector<Part> parts = test::read_parts(folder.file("out"));
            EXPECT_NEAR(median_edge_inside(parts, RegionIndex(0)), of_the_other, 0.2 * of_the_other);
            EXPECT_NEAR(median_edge_inside(parts, RegionIndex(1)), size, 0.2 * size);
        }
    }
}

}  // namespace
}  // namespace kerf
