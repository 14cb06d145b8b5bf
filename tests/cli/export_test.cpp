// kerf export: where its files go, and what it leaves alone.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/all_formats.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class Export : public testing::Test {
 protected:
    void SetUp() override { mesh({}); }
    void mesh(std::vector<std::string> more) const {
        more.insert(more.begin(), {"mesh", test::asset_path("hollow_box"), "-o", run_, "-n", "5", "-q"});
        const ChildResult result = test::run_kerf(more);
        ASSERT_EQ(result.exit_code, 0) << result.log;
    }
    ChildResult export_to(const std::string& out, const std::string& formats,
                          std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"export", run_, "--format", formats});
        if (!out.empty()) more.insert(more.end(), {"-o", folder_.file(out)});
        return test::run_kerf(more);
    }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories(fs::path(folder_.file(name)).parent_path());
        std::ofstream(folder_.file(name)) << text;
    }

    test::TemporaryFolder folder_;
    std::string run_ = folder_.file("run");
};

TEST_F(Export, WithoutAFolderTheFilesBecomePartOfTheRun) {
    const ChildResult result = export_to("", "msh,su2");
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_TRUE(fs::exists(run_ + "/export/msh/mesh_5.msh"));
    EXPECT_TRUE(fs::exists(run_ + "/export/su2/mesh.su2"));
    EXPECT_EQ(test::run_kerf({"verify", run_}).exit_code, 0);
    const auto once = test::contents_below(run_);
    EXPECT_EQ(export_to("", "su2").exit_code, 0);
    EXPECT_TRUE(test::contents_below(run_) == once) << "and stay the same when they are written again";
    const auto exported = test::result_of_run(run_);
    mesh({"--format", "vtu,msh,su2"});
    EXPECT_TRUE(test::result_of_run(run_) == exported) << "a run replaces them and writes the same";
    std::ofstream(run_ + "/export/su2/mesh.su2", std::ios::app) << "x";
    EXPECT_EQ(test::run_kerf({"verify", run_}).exit_code, 8);
}

TEST_F(Export, ARunWithoutVtuIsExportedToTheSameFiles) {
    ASSERT_EQ(export_to("of_vtu", test::all_formats()).exit_code, 0);
    mesh({"--format", "medit"});
    EXPECT_FALSE(fs::exists(run_ + "/mesh.pvtu"));
    EXPECT_EQ(test::run_kerf({"verify", run_}).exit_code, 0);
    ASSERT_EQ(export_to("of_store", test::all_formats()).exit_code, 0);
    EXPECT_TRUE(test::contents_below(folder_.file("of_vtu")) == test::contents_below(folder_.file("of_store")));
}

TEST_F(Export, AFolderKeepsTheFilesOfOthers) {
    write("case/0/T", "a field");
    write("case/system/controlDict", "of the user");
    ASSERT_EQ(export_to("case", "openfoam", {"--into", "3"}).exit_code, 0);
    EXPECT_EQ(test::bytes_of_file(folder_.file("case/0/T")), "a field");
    EXPECT_EQ(test::bytes_of_file(folder_.file("case/system/controlDict")), "of the user");
    EXPECT_TRUE(fs::exists(folder_.file("case/processor2/constant/polyMesh/faces")));
    ASSERT_EQ(export_to("case", "openfoam").exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_.file("case/processor4/constant/polyMesh/faces")));
    EXPECT_EQ(test::bytes_of_file(folder_.file("case/0/T")), "a field");
    const auto before = test::contents_below(folder_.file("case"));
    EXPECT_EQ(export_to("case", "openfoam").exit_code, 0);
    EXPECT_TRUE(test::contents_below(folder_.file("case")) == before);
    ASSERT_EQ(export_to("case", "mfem").exit_code, 0);
    EXPECT_FALSE(fs::exists(folder_.file("case/processor0"))) << "files of the export before go away";
    EXPECT_EQ(test::bytes_of_file(folder_.file("case/0/T")), "a field");
}

TEST_F(Export, AFileOfOthersInTheWayIsRefusedBeforeAnythingHasChanged) {
    write("out/mesh.su2", "of somebody else");
    const auto before = test::contents_below(folder_.file("out"));
    const ChildResult result = export_to("out", "su2");
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_NE(result.log.find("out/mesh.su2"), std::string::npos) << result.log;
    EXPECT_TRUE(test::contents_below(folder_.file("out")) == before);
    ASSERT_EQ(export_to("list", "su2").exit_code, 0);
    std::ofstream(folder_.file("list/kerf_export.json"), std::ios::app) << "x";
    EXPECT_EQ(export_to("list", "su2").exit_code, 7);
}

TEST_F(Export, SaysWhatIsWrong) {
    const auto expect = [&](const ChildResult& result, int code, const std::string& words) {
        EXPECT_EQ(result.exit_code, code) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
    };
    expect(export_to("out", "vtu,stl"), 2, "'stl' is no format. There are vtu, ");
    expect(export_to("out", ""), 2, "no format");
    expect(export_to("out", "su2", {"--into", "6"}), 2, "1 to 5");
    expect(export_to("", "su2", {"--into", "2"}), 2, "--output");
    expect(export_to("run/export", "su2"), 2, "lies in the run");
    expect(export_to("out", "su2", {"--msh-ascii"}), 2, "--msh-ascii is for the format msh");
    expect(export_to("out", "su2", {"--patch-type", "all=wall"}), 2, "--patch-type is for the format openfoam");
    expect(export_to("out", "openfoam", {"--patch-type", "none=wall"}), 2, "which the surface does not have. It has ");
    expect(export_to("out", "su2", {"--split-regions"}), 2, "--split-regions is for the format openfoam");
    expect(export_to("out", "openfoam", {"--split-regions"}), 2, "the surface has one region");
    for (const char* format : {"vtu", "openfoam"})
        expect(test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder_.file("out"), "--format", format,
                               "--split-regions"}),
               2, "--split-regions");
    expect(test::run_kerf({"merge", run_, "-o", folder_.file("a.su2"), "--msh-ascii"}), 2, "end with .msh");
    expect(test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder_.file("out"), "--patch-type", "none=wall"}),
           2, "which the surface does not have. It has ");
    expect(test::run_kerf({"export", folder_.file("none"), "--format", "su2"}), 7, "is not a finished run");
    expect(test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder_.file("out"), "--format", "obj"}), 2,
           "'obj' is no format");
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"run"});
}

TEST_F(Export, TypesOfPatchesAreThoseOfTheRunUnlessOthersAreAskedFor) {
    const auto mesh =
        test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder_.file("typed"), "-n", "1", "--feature-angle",
                        "40", "--patch-type", "face_*=wall", "--patch-type", "face_2=symmetry"});
    ASSERT_EQ(mesh.exit_code, 0) << mesh.log;
    const auto types = [&](const std::string& to, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"export", folder_.file("typed"), "--format", "openfoam",
                                          "-o",     folder_.file(to)};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(test::run_kerf(words).exit_code, 0);
        const std::string boundary = test::bytes_of_file(folder_.file(to + "/constant/polyMesh/boundary"));
        std::vector<std::string> found;
        std::istringstream lines(boundary.substr(boundary.find('(')));
        for (std::string word; lines >> word;)
            if (word == "type" && lines >> word) found.push_back(word.substr(0, word.find(';')));
        return found;
    };
    EXPECT_EQ(types("kept", {}), (std::vector<std::string>{"wall", "symmetry", "wall", "wall", "wall", "wall"}));
    EXPECT_EQ(types("asked", {"--patch-type", "face_1=patch"}),
              (std::vector<std::string>{"patch", "symmetry", "wall", "wall", "wall", "wall"}));
}

}  // namespace
}  // namespace kerf
