// kerf merge as a user starts it.
#include <filesystem>

#include <gtest/gtest.h>

#include "export/cases.h"
#include "files/export/format.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using FileNames = std::vector<std::string>;

class Merge : public testing::Test {
 protected:
    ChildResult merge(const std::string& output) const {
        return test::run_program(test::kerf_program(), {"merge", run_, "-o", output});
    }
    void expect_refused(const std::string& output, int exit_code, const std::string& words) const {
        const FileNames before = folder_.names();
        const auto run_before = test::contents_below(run_);
        const ChildResult result = merge(output);
        EXPECT_EQ(result.exit_code, exit_code) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
        EXPECT_EQ(folder_.names(), before);
        EXPECT_TRUE(test::contents_below(run_) == run_before);
    }

    const std::string run_ = test::run_of(test::export_cases()[1]);
    test::TemporaryFolder folder_;
};

TEST_F(Merge, TheEndingChoosesTheFormat) {
    const ChildResult result = merge(folder_.file("a.b.su2"));
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("a.b.su2: "), std::string::npos) << result.log;
    EXPECT_NE(result.log.find(" tetrahedra, "), std::string::npos) << result.log;
    EXPECT_TRUE(test::bytes_of_file(folder_.file("a.b.su2")).starts_with("NDIME= 3\n"));
    EXPECT_EQ(merge(folder_.file("c.node")).exit_code, 0);
    EXPECT_EQ(folder_.names(), (FileNames{"a.b.su2", "c.ele", "c.face", "c.node"}));
}

TEST_F(Merge, UnknownEndingsAreRefused) {
    std::string endings;
    for (const Format* format : formats())
        if (format->ending) endings += (endings.empty() ? "" : ", ") + std::string(format->ending);
    for (const char* name : {"mesh", "mesh.stl", "mesh.su2.gz", ".su2"})
        expect_refused(folder_.file(name), 2, "There are " + endings + ".");
}

TEST_F(Merge, NoFileOfTheRunIsWrittenOver) {
    expect_refused(run_ + "/parts/part_0008.vtu", 7, "lies in the run");
    expect_refused(run_ + "/new.vtu", 7, "lies in the run");
    std::filesystem::create_symlink(run_ + "/mesh.vtu", folder_.file("link.vtu"));
    expect_refused(folder_.file("link.vtu"), 7, "lies in the run");
}

TEST_F(Merge, OlderFilesAreReplacedAsAWhole) {
    std::filesystem::create_directory(folder_.file("elsewhere"));
    const std::string target = folder_.file("elsewhere/older.mesh"), link = folder_.file("link.mesh");
    std::ofstream(target) << "MeshVersionFormatted 1\n";
    std::filesystem::permissions(target, std::filesystem::perms(0640));
    std::filesystem::create_symlink("elsewhere/older.mesh", link);
    EXPECT_EQ(merge(link).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_TRUE(test::bytes_of_file(target).starts_with("MeshVersionFormatted 2\n"));
    EXPECT_EQ(std::filesystem::status(target).permissions(), std::filesystem::perms(0640));
    EXPECT_EQ(test::contents_below(folder_.file("elsewhere")).size(), 1U);

    std::filesystem::create_directory(folder_.file("folder.mesh"));
    expect_refused(folder_.file("folder.mesh"), 7, "folder.mesh");
    expect_refused(folder_.file("missing/new.mesh"), 7, "new.mesh");
    std::ofstream(folder_.file("whole.node")) << "0 3 0 0\n";
    std::filesystem::create_directory(folder_.file("whole.ele"));
    expect_refused(folder_.file("whole.node"), 7, "whole.ele");
    EXPECT_EQ(test::bytes_of_file(folder_.file("whole.node")), "0 3 0 0\n");
}

TEST_F(Merge, WhatIsNoFinishedRunIsRefused) {
    std::filesystem::create_directory(folder_.file("empty"));
    const ChildResult result =
        test::run_program(test::kerf_program(), {"merge", folder_.file("empty"), "-o", folder_.file("a.su2")});
    EXPECT_EQ(result.exit_code, 7) << result.log;
    EXPECT_EQ(folder_.names(), FileNames{"empty"});
}

}  // namespace
}  // namespace kerf
