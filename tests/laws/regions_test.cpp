// The laws of whole runs, for bodies of several regions that touch in every way.
#include <gtest/gtest.h>

#include "part/run_parts.h"
#include "support/checked_run.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

using Cube = std::array<std::int32_t, 3>;

struct RegionsCase {
    const char* name;
    Cube cubes;
    test::RegionOfCube region;
};

bool is_inside(const Cube& cube, std::int32_t low, std::int32_t high) {
    return std::all_of(cube.begin(), cube.end(), [&](std::int32_t c) { return c >= low && c < high; });
}

std::vector<RegionsCase> cases() {
    return {
        {"two_at_a_wall", {2, 1, 1}, [](Cube c) { return c[0]; }},
        {"three_at_an_edge", {2, 2, 1}, [](Cube c) { return c[0] + 2 * c[1] - 1; }},
        {"eight_at_a_point", {2, 2, 2}, [](Cube c) { return c[0] + 2 * c[1] + 4 * c[2]; }},
        {"twenty_layers", {2, 2, 20}, [](Cube c) { return c[2]; }},
        {"one_in_another", {3, 3, 3}, [](Cube c) { return is_inside(c, 1, 2) ? 1 : 0; }},
        {"void_in_one_in_another",
         {5, 5, 5},
         [](Cube c) { return is_inside(c, 2, 3)   ? -1
                             : is_inside(c, 1, 4) ? 1
                                                  : 0; }},
        {"two_at_an_edge", {2, 2, 1}, [](Cube c) { return c[0] != c[1] ? -1 : c[0]; }},
        {"two_at_a_vertex", {2, 2, 2}, [](Cube c) { return c[0] != c[1] || c[1] != c[2] ? -1 : c[0]; }},
        {"one_twice_at_an_edge", {2, 2, 1}, [](Cube c) { return c[0] == c[1] ? 0 : 1; }},
        {"grains", {6, 6, 6}, test::grains({6, 6, 6}, 12, 1)},
    };
}

class SeveralRegions : public testing::TestWithParam<RegionsCase> {};
INSTANTIATE_TEST_SUITE_P(Bodies, SeveralRegions, testing::ValuesIn(cases()),
                         [](const auto& param) { return param.param.name; });

TEST_P(SeveralRegions, ObeyEveryLawForAnyNumberOfParts) {
    constexpr std::int32_t fineness = 3;
    const Cube cubes = {fineness * GetParam().cubes[0], fineness * GetParam().cubes[1], fineness * GetParam().cubes[2]};
    const test::VoxelBody body = test::voxel_body(cubes, test::refined(GetParam().region, fineness));
    const auto regions = static_cast<std::int32_t>(body.names.size());
    for (const std::int32_t parts : {1, regions + 3, 4 * regions}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        Input input = make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
        for (std::size_t r = 0; r < body.volumes.size(); ++r)
            EXPECT_NEAR(input.regions[r].volume, body.volumes[r], 1e-9 * body.volumes[r]);
        const test::TemporaryFolder folder;
        const RunReport report = test::run_parts("", folder.file("out"), parts, input);
        test::expect_verified(report, std::max(parts, regions));
        EXPECT_EQ(test::broken_laws(test::read_parts(folder.file("out")), test::to_complex(body)), "");
        EXPECT_EQ(test::broken_sharing(RunParts(folder.file("out"))), "");
    }
}

}  // namespace
}  // namespace kerf
