// kerf repair as a user sees it, and the same repairs as an option of other commands.
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/surface_reader.h"
#include "support/assets.h"
#include "support/damage.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

using Json = nlohmann::json;

class RepairCommand : public testing::Test {
 protected:
    std::string write(const Soup& soup, const char* name = "bad.off") const {
        test::write_off(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    }
    ChildResult repair(const std::string& input, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"repair", input, "-o", out_});
        return test::run_kerf(more);
    }
    Json repair_json(const std::string& input, std::vector<std::string> more = {}) const {
        more.push_back("--json");
        return Json::parse(test::output_of(repair(input, more)));
    }
    static void expect_said(const std::string& text, const std::vector<std::string>& parts) {
        for (const std::string& part : parts) EXPECT_NE(text.find(part), text.npos) << part << " in\n" << text;
    }

    test::TemporaryFolder folder_;
    std::string out_ = folder_.file("out.obj");
};

// Each facet with vertices of its own, none nearer to its place than a thousandth of the tolerance.
Soup torn_box() { return test::cracked(test::box(), 1e-8, 1); }

Soup open_box() {
    Soup soup = test::box();
    test::remove_facet(soup, 0);
    return soup;
}

TEST_F(RepairCommand, WhatIsCleanIsCopiedByteForByteAndSaidToBe) {
    out_ = folder_.file("out.stl");
    const ChildResult result = repair(test::asset_path("cube"));
    EXPECT_EQ(result.exit_code, 0) << result.log;
    expect_said(result.log, {"nothing to repair", "a copy, byte for byte", "4,660 facets. It can be meshed."});
    EXPECT_TRUE(test::bytes_of_file(out_) == test::bytes_of_file(test::asset_path("cube")));
    const Json json = repair_json(test::asset_path("cube"));
    EXPECT_TRUE(json["unchanged"] == true && json["copied"] == true && json["can_be_meshed"] == true);
    EXPECT_EQ(json["before"], json["after"]);
}

TEST_F(RepairCommand, WhatIsCleanHasTheSameFacetsInAnotherFormat) {
    const Soup before = read_surface(test::asset_path("hollow_box"));
    for (const char* name : {"out.obj", "out.ply", "out.off", "out.vtp", "out.vtk"}) {
        out_ = folder_.file(name);
        const ChildResult result = repair(test::asset_path("hollow_box"));
        EXPECT_EQ(result.exit_code, 0) << result.log;
        expect_said(result.log, {"the output has the same facets"});
        const Soup after = read_surface(out_);
        EXPECT_EQ(after.facets, before.facets) << name;
        EXPECT_TRUE(after.vertices == before.vertices) << name;
    }
}

TEST_F(RepairCommand, EachStepIsSaidWithCountsAndWhatTheResultIs) {
    const std::string bad = write(torn_box());
    const ChildResult result = repair(bad, {"--repair", "weld=1e-6"});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    expect_said(result.log, {"not closed\n", "\n  weld          ", " vertices merged",
                             "\n  moved         no vertex by more", "\n  changed       ",
                             "from the input, which is proven", "before, it was not closed", "It can be meshed."});
    EXPECT_EQ(test::run_kerf({"check", out_}).exit_code, 0);
    const Json json = repair_json(bad, {"--repair", "weld=1e-6"});
    EXPECT_EQ(json["repair"]["steps"][0]["step"], "weld");
    EXPECT_EQ(json["repair"]["steps"][0]["actions"][0]["done"], true);
    EXPECT_EQ(json["before"]["volume"], nullptr);
    EXPECT_NEAR(json["after"]["volume"], 1, 1e-6);
    EXPECT_LE(json["distance_of_changed"], 1e-6);
    EXPECT_LE(json["repair"]["largest_move"], 1e-6);
    EXPECT_EQ(json["faces_added"], 0);
}

TEST_F(RepairCommand, WhatIsLeftIsSaidWithWhatToDoNext) {
    const ChildResult result = repair(write(open_box()), {"--repair", "weld"});
    EXPECT_EQ(result.exit_code, 3) << result.log;
    expect_said(result.log, {"It cannot be meshed yet:", "1 open edge loop", "kerf repair ", " -o bad_"});
    EXPECT_EQ(read_surface(out_).facets.size(), open_box().facets.size()) << "it is written all the same";
    const Json json = repair_json(write(open_box()), {"--repair", "weld"});
    EXPECT_EQ(json["can_be_meshed"], false);
    EXPECT_EQ(json["counts"], (Json{{"open edge loop", 1}}));
    EXPECT_TRUE(json["remedy"].contains("command"));
}

TEST_F(RepairCommand, SeveralFilesAreBodiesThatMayBecomeRegions) {
    const std::string left = write(test::box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "left.off"),
                      right = write(test::box(Vec3(1, 0, 0), Vec3(2, 1, 1)), "right.off");
    for (const char* name : {"out.obj", "out.vtp", "out.vtk"}) {
        out_ = folder_.file(name);
        const ChildResult result = repair(left, {right, "--repair", "none"});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        const std::string text = test::output_of(test::run_kerf({"check", out_}));
        expect_said(text, {"left: volume 1", "right: volume 1", "It can be meshed."});
    }
    for (const char* name : {"out.stl", "out.ply", "out.off"}) {
        out_ = folder_.file(name);
        const ChildResult refused = repair(left, {right, "--repair", "none"});
        EXPECT_EQ(refused.exit_code, 2) << refused.log;
        expect_said(refused.log, {"2 regions", "Write an .obj"});
    }
}

// Bodies with names of their own are regions where one lies inside of the other, and nothing is wrong with them.
TEST_F(RepairCommand, BodiesInsideOfOthersStay) {
    const std::string nested = folder_.file("nested.stl");
    Soup skin = test::box(Vec3(0, 0, 0), Vec3(4, 4, 4)), skull = test::box(Vec3(1, 1, 1), Vec3(3, 3, 3));
    skin.patch_names = {"skin"};
    skull.patch_names = {"skull"};
    for (Soup* body : {&skin, &skull}) body->patch.assign(body->facets.size(), 0);
    std::ofstream(nested) << test::to_ascii_stl(skin) << test::to_ascii_stl(skull);
    out_ = folder_.file("out.stl");
    const ChildResult result = repair(nested, {});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_EQ(test::bytes_of_file(out_), test::bytes_of_file(nested));
}

// Two boxes whose sides are nearer than what 32-bit floats tell apart.
TEST_F(RepairCommand, AnStlThatItsSevenDigitsWouldSpoilIsRefused) {
    const double gap = 1e-9;
    const std::string bad = write(test::join(test::box(), test::box(Vec3(1 + gap, 0, 0), Vec3(2, 1, 1))));
    EXPECT_EQ(repair(bad, {"--repair", "none"}).exit_code, 0);
    out_ = folder_.file("out.stl");
    const ChildResult result = repair(bad, {"--repair", "none"});
    EXPECT_EQ(result.exit_code, 3) << result.log;
    expect_said(result.log, {"7 digits", "Write an .obj"});
    EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(RepairCommand, WrongPlansAndOutputsAreRefusedBeforeTheWork) {
    const std::string bad = write(open_box());
    for (const char* command : {"repair", "mesh", "check", "remesh", "decompose"}) {
        std::vector<std::string> words = {command, bad, "--repair", "weld,holse"};
        const bool makes_folder = words[0] == "mesh" || words[0] == "decompose";
        if (words[0] != "check") words.insert(words.end(), {"-o", makes_folder ? folder_.file("run") : out_});
        const ChildResult result = test::run_kerf(words);
        EXPECT_EQ(result.exit_code, 2) << command;
        expect_said(result.log, {"--repair has 'holse'", "weld=TOL", "bodies=unite|regions"});
    }
    EXPECT_EQ(repair(bad, {"--thicken", "-1"}).exit_code, 2);
    EXPECT_EQ(test::run_kerf({"repair", bad, "-o", folder_.file("out.xyz")}).exit_code, 2);
    EXPECT_EQ(test::run_kerf({"repair", bad, "-o", folder_.file("no/such.obj")}).exit_code, 7);
    const std::string itself = write(open_box(), "itself.obj"), bytes = test::bytes_of_file(itself);
    EXPECT_EQ(test::run_kerf({"repair", itself, "-o", itself}).exit_code, 7);
    EXPECT_EQ(test::bytes_of_file(itself), bytes);
}

// The C library lays blocks of memory elsewhere: facets that are crossed often are divided in many of them.
TEST_F(RepairCommand, DoesNotDependOnAddresses) {
    const Soup soup = test::join(test::box(Vec3(-1.2, -1.3, -0.1), Vec3(1.3, 1.2, 0.2)), test::uv_sphere(40, 60));
    const std::string input = write(soup), run = folder_.file("run");
    std::set<std::string> surfaces;
    for (const int threshold : {131072, 16384, 4096, 1024}) {
        const ChildResult result =
            test::run_program("/usr/bin/env", {fmt::format("GLIBC_TUNABLES=glibc.malloc.mmap_threshold={}", threshold),
                                               test::kerf_program(), "decompose", input, "--repair", "full",
                                               "--surface", "keep", "-n", "1", "-o", run, "-q"});
        ASSERT_EQ(result.exit_code, 0) << result.log;
        surfaces.insert(test::bytes_of_file(run + "/surfaces.vtu"));
    }
    EXPECT_EQ(surfaces.size(), 1u);
}

TEST_F(RepairCommand, ARunWithRepairsReportsAndVerifiesThem) {
    const std::string bad = write(test::cracked(read_surface(test::asset_path("hollow_box")), 5e-10, 1)),
                      out = folder_.file("out");
    const ChildResult meshed = test::run_kerf({"mesh", bad, "-o", out, "-n", "2", "--repair", "weld=1e-6,orient"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    expect_said(meshed.log, {"repair      weld: ", " vertices merged"});
    const Json report = Json::parse(test::bytes_of_file(out + "/report.json"));
    EXPECT_EQ(report["options"]["repair"], "weld=1e-6,orient");
    EXPECT_EQ(report["input"]["repair"]["steps"][0]["step"], "weld");
    EXPECT_GT(report["input"]["repair"]["steps"][0]["actions"][0]["count"], 1000);
    EXPECT_EQ(report["input"]["repairs"]["vertices_merged"], 0) << "that is what --weld has done";
    EXPECT_EQ(test::run_kerf({"verify", out}).exit_code, 0);
}

TEST_F(RepairCommand, CheckSaysWhichLevelWouldDo) {
    const std::string bad = write(torn_box());
    const ChildResult result = test::run_kerf({"check", bad});
    EXPECT_EQ(result.exit_code, 3);
    expect_said(test::output_of(result),
                {"Repaired, it can be", "kerf repair " + bad + " -o bad_repaired.obj --repair near"});
    const Json json = Json::parse(test::output_of(test::run_kerf({"check", bad, "--json"})));
    EXPECT_EQ(json["remedy"]["repair"], "near");
    EXPECT_EQ(json["remedy"]["tried"], true);
    const ChildResult with = test::run_kerf({"check", bad, "--repair", "near"});
    EXPECT_EQ(with.exit_code, 0) << test::output_of(with);
    expect_said(test::output_of(with), {"vertices merged", "It can be meshed."});
    const Json clean = Json::parse(test::output_of(test::run_kerf({"check", test::asset_path("cube"), "--json"})));
    EXPECT_FALSE(clean.contains("remedy"));
    EXPECT_FALSE(clean.contains("repair")) << "nothing was asked for";
}

}  // namespace
}  // namespace kerf
