// Materials by the names of regions.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "part/run_parts.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/run_in_process.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

// A bar of 2 x 1 x 1 cubes along x, of a region for each half, in six parts. Its ends are patches.
class BarOfTwo : public testing::Test {
 protected:
    static constexpr std::int32_t fineness = 3;

    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        const test::VoxelBody bar =
            test::voxel_body({2 * fineness, fineness, fineness},
                             test::refined([](std::array<std::int32_t, 3> cube) { return cube[0]; }, fineness));
        std::vector<std::int32_t> patch;
        for (const Triangle& t : bar.facets.facets) {
            const auto all_at = [&](double x) {
                return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return bar.facets.vertices[v].x() == x; });
            };
            patch.push_back(all_at(0) ? 0 : all_at(2 * fineness) ? 1 : 2);
        }
        Input input = make_input(bar.facets.vertices, bar.facets.facets, bar.sides, {"rubber", "steel"}, patch,
                                 {"held", "pulled", "sides"});
        ASSERT_EQ(test::run_parts("", folder_->file("bar"), 6, input).exit_code, 0);
    }
    static void TearDownTestSuite() { folder_.reset(); }

    ChildResult solve(const std::string& materials) const {
        std::ofstream(own_.file("case.toml")) << materials << R"(
[[support]]
patch = "held"
x = 0
[[support]]
point = [0, 0, 0]
y = 0
z = 0
[[support]]
point = [0, 3, 0]
z = 0
[[load]]
patch = "pulled"
traction = [2, 0, 0]
)";
        return test::run_kerf(
            {"solve", folder_->file("bar"), "--case", own_.file("case.toml"), "-o", own_.file("out"), "-q"});
    }
    inline static std::unique_ptr<test::TemporaryFolder> folder_;
    test::TemporaryFolder own_;
};

// A patch test across materials: the stress is the same on both sides of the wall, the strain is not.
TEST_F(BarOfTwo, PulledHasTheStressOfTheLoadAndTheStrainsOfItsMaterials) {
    const ChildResult result =
        solve("[material.rubber]\nyoung = 10\npoisson = 0\n[material.steel]\nyoung = 1000\npoisson = 0\n");
    ASSERT_EQ(result.exit_code, 0) << result.log;
    const RunParts solution(folder_->file("bar"), own_.file("out"));
    for (const PartIndex index : solution.outline().parts.ids()) {
        const Part part = solution.load(index);
        const bool is_rubber = part.region_of(0).value() == 0;
        for (const PartValues& values : part.values)
            for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) {
                const double x = part.mesh.vertices[v].x();
                if (values.name == "Displacement") {
                    EXPECT_NEAR(values.number(3 * v), is_rubber ? 0.2 * x : 0.6 + 0.002 * (x - 3), 1e-6);
                }
                if (values.name == "Stress" && values.of == PartValues::Of::points) {
                    EXPECT_NEAR(values.number(6 * v), 2, 1e-5);
                }
            }
    }
    const auto of_case = nlohmann::json::parse(test::bytes_of_file(own_.file("out/report.json")))["solve"]["cases"][0];
    ASSERT_EQ(of_case["regions"].size(), 2U);
    EXPECT_EQ(of_case["regions"][0]["name"], "rubber");
    // Half of stress times strain times volume.
    EXPECT_NEAR(of_case["regions"][0]["strain_energy"], 0.5 * 2 * 0.2 * 27, 1e-5);
    EXPECT_NEAR(of_case["regions"][1]["strain_energy"], 0.5 * 2 * 0.002 * 27, 1e-7);
}

TEST_F(BarOfTwo, MaterialsSayTheirRegionsOrAreForTheRest) {
    EXPECT_EQ(solve("[material.a]\nyoung = 10\npoisson = 0\nregion = \"rubber\"\n"
                    "[material.b]\nyoung = 20\npoisson = 0\n")
                  .exit_code,
              0);
    const auto refused = [&](const std::string& materials, const char* words) {
        const ChildResult result = solve(materials);
        EXPECT_EQ(result.exit_code, 2) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
    };
    std::filesystem::remove_all(own_.file("out"));
    refused("[material.a]\nyoung = 10\npoisson = 0\nregion = \"wood\"\n", "those of the mesh are 'rubber', 'steel'");
    refused("[material.steel]\nyoung = 10\npoisson = 0\n", "tetrahedra have no material");
    refused("[material.steel]\nyoung = 10\npoisson = 0\n[material.b]\nyoung = 1\npoisson = 0\nregion = \"steel\"\n",
            "The region 'steel' has two materials");
}

}  // namespace
}  // namespace kerf
