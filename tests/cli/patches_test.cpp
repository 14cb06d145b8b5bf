// Patches from the file to the boundary triangles of the parts: names and numbers, for each format that has them.
#include <algorithm>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "prepare/input.h"
#include "support/assets.h"
#include "support/program.h"
#include "support/run_laws.h"
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
                   {"face_0", "face_1", "face_2", "face_3", "face_4", "face_5"});
}

TEST_F(Patches, FeatureAngleLeavesThePatchesOfTheFile) {
    const Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 6);
    expect_patches(mesh(write("box.obj", test::to_obj(box)), {"--feature-angle", "40"}), box.patch, box.patch_names);
}

}  // namespace
}  // namespace kerf
