// Patches from the file to the boundary triangles of the parts: names and numbers, for each format that has them.
#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/file_bytes.h"
#include "files/part/run_parts.h"
#include "run/prepare/input.h"
#include "support/assets.h"
#include "support/program.h"
#include "support/run_laws.h"
#include "support/sealed_run.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class Patches : public testing::Test {
 protected:
    std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_.file(name), std::ios::binary) << bytes;
        return folder_.file(name);
    }
    std::vector<Part> mesh(const std::string& path, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"mesh", path, "-o", folder_.file("out"), "-n", "3", "-q"});
        const ChildResult result = test::run_kerf(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return test::read_parts(folder_.file("out"));
    }

    test::TemporaryFolder folder_;
};

// Every boundary triangle that a facet of the input holds has the patch of that facet.
void expect_patches(const std::vector<Part>& parts, const std::vector<std::int32_t>& patch,
                    const std::vector<std::string>& names) {
    EXPECT_EQ(parts.size(), 3u);
    std::set<std::int32_t> seen;
    for (const Part& part : parts) {
        EXPECT_EQ(part.patch_names, names);
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (part.facet[f] < 0) continue;
            ASSERT_LT(part.facet[f], static_cast<std::int32_t>(patch.size()));
            EXPECT_EQ(part.patch[f], patch[part.facet[f]]) << "facet " << part.facet[f];
            seen.insert(part.patch[f]);
        }
    }
    EXPECT_EQ(seen.size(), names.size()) << "every patch has a triangle";
}

TEST_F(Patches, AreListedWithWhatFormatsCallThem) {
    Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 2);
    box.patch_names[0] = "in%let";
    const ChildResult result = test::run_kerf({"check", write("box.obj", test::to_obj(box)), "--list-patches"});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    const std::string text = test::output_of(result);
    // Of the wall x = 0: 8 triangles, 2 x 3, in the middle, to the left.
    EXPECT_NE(text.find("8            6  (0, 1, 1.5)"), std::string::npos) << text;
    EXPECT_NE(text.find("(-1.000, 0.000, 0.000)"), std::string::npos) << text;
    EXPECT_NE(text.find("  in%let: in_let in "), std::string::npos) << text;
    EXPECT_EQ(text.find("  " + box.patch_names[1] + ":"), std::string::npos) << "a word stays: " << text;
    for (std::size_t p = 0; p < box.patch_names.size(); ++p) box.patch_names[p] = fmt::format("solid 1/face {}", p + 1);
    const std::string many =
        test::output_of(test::run_kerf({"check", write("many.obj", test::to_obj(box)), "--list-patches"}));
    const std::size_t rule = many.find("  solid 1/face 1: solid_1_face_1, and 5 more with _ likewise in ");
    EXPECT_NE(rule, std::string::npos) << many;
    EXPECT_EQ(std::count(many.begin() + rule, many.end(), '\n'), 1) << "the rule is said once: " << many;
    const ChildResult features = test::run_kerf(
        {"check", write("box.stl", test::to_binary_stl(box)), "--list-patches", "--feature-angle", "40"});
    EXPECT_EQ(std::count(features.output.begin(), features.output.end(), '\n'), 7) << test::output_of(features);
}

TEST_F(Patches, NamesOfSolidsGroupsAndPhysicalGroupsArriveInThePartFiles) {
    const Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 6);
    for (const test::SurfaceFile& file : {test::SurfaceFile{"solids.stl", test::to_ascii_stl(box)},
                                          {"groups.obj", test::to_obj(box)},
                                          {"groups.msh", test::to_msh(box, {})},
                                          {"groups22.msh", test::to_msh(box, {.is_msh41 = false})}}) {
        SCOPED_TRACE(file.name);
        expect_patches(mesh(write(file.name, file.bytes)), box.patch, box.patch_names);
    }
}

TEST_F(Patches, NumbersOfReferencesAndMarkersArriveInThePartFiles) {
    const Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 6);
    std::vector<std::string> references, markers;
    for (int p = 0; p < 6; ++p) {
        references.push_back("reference_" + std::to_string(10 - p));
        markers.push_back("marker_" + std::to_string(10 - p));
    }
    expect_patches(mesh(write("box.mesh", test::to_medit(box))), box.patch, references);
    std::string smesh = test::to_tetgen(box, 1, false);
    smesh.replace(smesh.find("1\n1 0.5 0.5 0.5"), std::string::npos, "0\n0\n");  // its hole is where its region is
    expect_patches(mesh(write("box.smesh", smesh)), box.patch, markers);
}

TEST_F(Patches, FeatureAngleMakesASideOfACubeAPatch) {
    const Soup cube = std::move(check_input(test::asset_path("cube")).soup);
    // A side by the coordinate plane that it lies in, numbered by its first facet.
    std::vector<int> sides;
    std::vector<std::int32_t> patch;
    for (const Triangle& t : cube.facets) {
        int side = -1;
        for (int i = 0; i < 6; ++i)
            if (std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return cube.vertices[v][i / 2] == i % 2; }))
                side = i;
        ASSERT_GE(side, 0);
        const auto found = std::find(sides.begin(), sides.end(), side);
        patch.push_back(static_cast<std::int32_t>(found - sides.begin()));
        if (found == sides.end()) sides.push_back(side);
    }
    ASSERT_EQ(sides.size(), 6u);
    expect_patches(mesh(test::asset_path("cube"), {"--feature-angle", "40"}), patch,
                   {"face_1", "face_2", "face_3", "face_4", "face_5", "face_6"});
}

TEST_F(Patches, FeatureAngleLeavesThePatchesOfTheFile) {
    const Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 6);
    expect_patches(mesh(write("box.obj", test::to_obj(box)), {"--feature-angle", "40"}), box.patch, box.patch_names);
}

// Their reports do not say the names, of which each of their files has all.
TEST_F(Patches, OfRunsOfOlderVersionsAreReadFromTheirParts) {
    const Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 6);
    mesh(write("box.obj", test::to_obj(box)));
    const std::string out = folder_.file("out"), report = out + "/report.json";
    nlohmann::json json = nlohmann::json::parse(read_file(report));
    EXPECT_EQ(json["input"].erase("patches"), 1u);
    std::ofstream(report) << json;
    test::seal_run(out);
    const RunParts parts(out);
    EXPECT_EQ(parts.outline().patch_names, box.patch_names);
    EXPECT_EQ(parts.load(PartIndex()).patch_names, NameTable(box.patch_names));
}

// A patch for each facet of a box with more than a part lists all of.
TEST_F(Patches, OfManyArePartsNamedByThoseThatTheyHaveAlone) {
    Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 6);
    box.patch_names.clear();
    for (std::size_t f = 0; f < box.facets.size(); ++f) {
        box.patch[f] = static_cast<std::int32_t>(f);
        box.patch_names.push_back("face of a facet with the number " + std::to_string(f));
    }
    std::vector<std::int32_t> seen;
    for (const Part& part : mesh(write("box.obj", test::to_obj(box)))) {
        EXPECT_FALSE(part.patch_names.is_whole());
        EXPECT_TRUE(part.patch_names.agrees_with(box.patch_names));
        for (std::size_t f = 0; f < part.facets.size(); ++f) EXPECT_EQ(part.patch[f], part.facet[f]);
        seen.insert(seen.end(), part.patch_names.numbers().begin(), part.patch_names.numbers().end());
    }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(seen, box.patch) << "each facet lies in one part";
    const std::string out = folder_.file("out");
    const ChildResult verified = test::run_kerf({"verify", out});
    EXPECT_EQ(verified.exit_code, 0) << verified.log;
    EXPECT_EQ(RunParts(out).outline().patch_names, box.patch_names);
    for (const std::string format : {"abaqus", "mfem"}) {
        const ChildResult exported = test::run_kerf({"export", out, "--format", format, "-o", folder_.file(format)});
        EXPECT_EQ(exported.exit_code, 0) << exported.log;
    }
}

// A grid of n x n x n cubes of six tetrahedra, each a region with a name.
std::string msh_of_cubes(int n) {
    const int m = n + 1;
    const auto node = [&](const std::array<int, 3>& p) { return 1 + p[0] + m * (p[1] + m * p[2]); };
    std::string names, nodes, cells;
    int count = 0;
    for (int i = 0; i < m * m * m; ++i) nodes += fmt::format("{} {} {} {}\n", i + 1, i % m, i / m % m, i / (m * m));
    for (int cube = 0; cube < n * n * n; ++cube) {
        names += fmt::format("3 {} \"grain {}\"\n", cube + 1, cube + 1);
        std::array<int, 3> axes = {0, 1, 2};
        do {
            std::array<int, 3> p = {cube % n, cube / n % n, cube / (n * n)};
            std::array<int, 4> tet = {node(p)};
            for (int i = 0; i < 3; ++i) {
                ++p[axes[i]];
                tet[i + 1] = node(p);
            }
            if ((axes[1] - axes[0] + 3) % 3 != 1) std::swap(tet[1], tet[2]);
            cells += fmt::format("{} 4 2 {} {} {}\n", ++count, cube + 1, cube + 1, fmt::join(tet, " "));
        } while (std::next_permutation(axes.begin(), axes.end()));
    }
    return fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}$EndPhysicalNames\n"
        "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
        n * n * n, names, m * m * m, nodes, count, cells);
}

// Names would else grow as the square of the regions: there are parts for each, and walls with names between them.
TEST_F(Patches, OfManyRegionsDoNotMakeFilesOfPartsLarger) {
    constexpr int n = 7;
    const std::string out = folder_.file("out");
    const ChildResult result = test::run_kerf({"decompose", write("grains.msh", msh_of_cubes(n)), "-o", out, "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.log;
    std::set<std::int32_t> regions;
    for (const Part& part : test::read_part_surfaces(out)) {
        ASSERT_EQ(part.region_names.size(), 1u);
        EXPECT_LE(part.patch_names.size(), 6u);
        const std::int32_t region = part.region_names.number(0);
        EXPECT_EQ(part.region_names.names().front(), fmt::format("grain {}", region + 1));
        regions.insert(region);
    }
    EXPECT_EQ(regions.size(), static_cast<std::size_t>(n * n * n));
    EXPECT_NE(read_file(out + "/surfaces.vtu").find(fmt::format("grain {}", n * n * n)), std::string::npos);
}

}  // namespace
}  // namespace kerf
