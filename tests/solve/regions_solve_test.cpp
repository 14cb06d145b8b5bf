// Materials by the names of regions, and what each region bears.
#include <array>
#include <cmath>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/tet_mesh_reader.h"
#include "files/part/run_parts.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/run_in_process.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

// Two cubes of a region each, in six parts, one behind the other along x as a bar, or side by side. The ends along x
// are patches.
class BarOfTwo : public testing::Test {
 protected:
    static constexpr std::int32_t fineness = 3;

    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        mesh_cubes("bar", 0);
        mesh_cubes("layers", 1);
    }
    // `axis`: along which the cubes follow each other.
    static void mesh_cubes(const std::string& name, std::size_t axis) {
        std::array<std::int32_t, 3> cubes = {fineness, fineness, fineness};
        cubes[axis] *= 2;
        const test::VoxelBody bar = test::voxel_body(
            cubes, test::refined([axis](std::array<std::int32_t, 3> cube) { return cube[axis]; }, fineness));
        std::vector<std::int32_t> patch;
        for (const Triangle& t : bar.facets.facets) {
            const auto all_at = [&](double x) {
                return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return bar.facets.vertices[v].x() == x; });
            };
            patch.push_back(all_at(0) ? 0 : all_at(cubes[0]) ? 1 : 2);
        }
        Input input = make_input(bar.facets.vertices, bar.facets.facets, bar.sides, {"rubber", "steel"}, patch,
                                 {"held", "pulled", "sides"});
        ASSERT_EQ(test::run_parts(std::move(input), folder_->file(name), 6).exit_code, 0);
    }
    static void TearDownTestSuite() { folder_.reset(); }

    ChildResult solve(const std::string& materials) const {
        return solve("bar", materials, "[[load]]\npatch = \"pulled\"\ntraction = [2, 0, 0]\n");
    }
    ChildResult solve(const std::string& name, const std::string& materials, const std::string& loads) const {
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
)" << loads;
        return test::run_kerf({"solve", folder_->file(name), "--case", own_.file("case.toml"), "-o", own_.file("out")});
    }
    nlohmann::json only_case() const {
        return nlohmann::json::parse(test::bytes_of_file(own_.file("out/report.json")))["solve"]["cases"][0];
    }
    static std::array<double, 3> place_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
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
    const nlohmann::json of_case = only_case();
    ASSERT_EQ(of_case["regions"].size(), 2U);
    EXPECT_EQ(of_case["regions"][0]["name"], "rubber");
    // Half of stress times strain times volume.
    EXPECT_NEAR(of_case["regions"][0]["strain_energy"], 0.5 * 2 * 0.2 * 27, 1e-5);
    EXPECT_NEAR(of_case["regions"][1]["strain_energy"], 0.5 * 2 * 0.002 * 27, 1e-7);
    // Only cells of rubber are held.
    EXPECT_EQ(of_case["regions"][0]["reactions"], of_case["reactions"]);
    EXPECT_NEAR(of_case["regions"][0]["reactions"][0]["reaction"][0], -2 * 9, 1e-5);
    EXPECT_EQ(of_case["regions"][1]["reactions"][0]["reaction"], nlohmann::json({0.0, 0.0, 0.0}));
    EXPECT_NE(result.log.find("region      rubber: reaction (-18, "), std::string::npos) << result.log;
}

// Layers of equal weight for their stiffness, which hang from one end, move alike. So each end bears the weight of its
// own layer, and vertices at the wall are held by both: elements of order 2 have that exactly.
TEST_F(BarOfTwo, EachLayerHangsByItself) {
    const ChildResult result = solve("layers",
                                     "[material.rubber]\nyoung = 10\npoisson = 0\ndensity = 1\n"
                                     "[material.steel]\nyoung = 1000\npoisson = 0\ndensity = 100\n",
                                     "[gravity]\nacceleration = [0.1, 0, 0]\n[solver]\norder = 2\nrtol = 1e-11\n");
    ASSERT_EQ(result.exit_code, 0) << result.log;
    const nlohmann::json of_case = only_case();
    const auto pull = [](const nlohmann::json& of) { return of["reactions"][0]["reaction"][0].get<double>(); };
    EXPECT_NEAR(pull(of_case["regions"][0]), -0.1 * 27, 1e-8);
    EXPECT_NEAR(pull(of_case["regions"][1]), -0.1 * 100 * 27, 1e-6);
    EXPECT_NEAR(pull(of_case["regions"][0]) + pull(of_case["regions"][1]), pull(of_case), 1e-12 * 273);
}

// Layers of which the same pull makes the same strains: stresses along the wall differ on its sides.
TEST_F(BarOfTwo, StressesAtAWallAreThoseOfEachSide) {
    const ChildResult result =
        solve("layers", "[material.rubber]\nyoung = 10\npoisson = 0\n[material.steel]\nyoung = 1000\npoisson = 0.3\n",
              "[[support]]\npatch = \"pulled\"\nx = 0.3\n");
    ASSERT_EQ(result.exit_code, 0) << result.log;
    std::map<std::int64_t, std::array<double, 2>> at_wall;  // von Mises stress of a vertex in both regions
    std::map<std::array<double, 3>, double> of_first;       // at a place, in the first part that has it
    const RunParts solution(folder_->file("layers"), own_.file("out"));
    for (const PartIndex index : solution.outline().parts.ids()) {
        const Part part = solution.load(index);
        const auto region = static_cast<std::size_t>(part.region_of(0).value());
        const auto stress = std::find_if(part.values.begin(), part.values.end(), [](const PartValues& values) {
            return values.name == "VonMises" && values.of == PartValues::Of::points;
        });
        for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) {
            of_first.emplace(place_of(part.mesh.vertices[v]), stress->number(v));
            if (part.mesh.vertices[v].y() == fineness) at_wall[part.global_id[v]][region] = stress->number(v);
        }
    }
    for (const auto& [vertex, stresses] : at_wall) EXPECT_GT(stresses[1], 10 * stresses[0]) << vertex;
    // Files of the whole have the stress of the first part.
    for (const char* name : {"whole.vtu", "whole.msh"}) {
        ASSERT_EQ(test::run_kerf({"merge", own_.file("out"), "-o", own_.file(name), "-q"}).exit_code, 0);
        const TetFile whole = read_tets_with_scalars(own_.file(name));
        for (const NodeScalar& scalar : whole.node_scalars)
            for (std::size_t v = 0; scalar.name == "VonMises" && v < scalar.values.size(); ++v)
                ASSERT_EQ(scalar.values[v], of_first.at(place_of(whole.mesh.vertices[v]))) << name << " vertex " << v;
    }
}

// A region that is warmed grows; what both bear is the same, and tables say so. Gravity is of one case alone.
TEST_F(BarOfTwo, IsWarmedByRegionAndToldInTables) {
    const ChildResult result =
        solve("bar", "[material.stuff]\nyoung = 1000\npoisson = 0\ndensity = 2\nexpansion = 1e-3\nyield = 5\n",
              "[[support]]\nname = \"wall\"\npatch = \"pulled\"\nx = 0\n"
              "[[temperature]]\nregion = \"steel\"\ndifference = 20\ncase = \"warm\"\n"
              "[[gravity]]\nacceleration = [1, 0, 0]\ncase = \"weight, all\"\n"
              "[[combination]]\nname = \"sum\"\ncases = {warm = 2, \"weight, all\" = 1}\n"
              "[solver]\norder = 2\nrtol = 1e-11\n");
    ASSERT_EQ(result.exit_code, 0) << result.log;
    const nlohmann::json cases =
        nlohmann::json::parse(test::bytes_of_file(own_.file("out/report.json")))["solve"]["cases"];
    ASSERT_EQ(cases.size(), 3U);
    const auto push = [&](std::size_t of_case, std::size_t support) {
        return cases[of_case]["reactions"][support]["reaction"][0].get<double>();
    };
    // Growth of 3 by 0.02 on a bar of 6, section 9: a force of 90, whatever the wall does to the sides.
    EXPECT_NEAR(
        cases[0]["least_safety_factor"]["value"].get<double>() * cases[0]["max_von_mises"]["value"].get<double>(), 5,
        1e-9);
    EXPECT_NEAR(push(0, 0), 90, 1e-6);
    EXPECT_NEAR(push(0, 3), -90, 1e-6);
    EXPECT_NEAR(push(1, 0) + push(1, 3), -2 * 54, 1e-6);
    EXPECT_NEAR(push(2, 0), 2 * push(0, 0) + push(1, 0), 1e-6);
    EXPECT_EQ(cases[2]["combination"]["warm"], 2);
    EXPECT_NEAR(cases[1]["reactions"][0]["moment"][1], 0, 1e-6);
    EXPECT_NEAR(cases[1]["reactions"][0]["about"][1], 1.5, 1e-12);
    const std::string results = test::bytes_of_file(own_.file("out/results.csv")),
                      reactions = test::bytes_of_file(own_.file("out/reactions.csv"));
    EXPECT_EQ(std::count(results.begin(), results.end(), '\n'), 1 + 3 * 3);
    EXPECT_NE(results.find("\n\"weight, all\",steel,"), std::string::npos) << results;
    EXPECT_EQ(std::count(reactions.begin(), reactions.end(), '\n'), 1 + 3 * 4 * 3);
    EXPECT_NE(reactions.find("\nsum,wall,,"), std::string::npos) << reactions;
    EXPECT_NE(result.log.find("sum of      2 warm + 1 weight, all"), std::string::npos) << result.log;
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
