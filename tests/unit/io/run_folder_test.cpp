#include "files/io/run_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "files/io/folder_files.h"
#include "files/io/run_manifest.h"
#include "support/io_error.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class RunFolderTest : public testing::Test {
 protected:
    std::string path(const std::string& name) const { return folder_.file(name); }
    std::size_t entries() const { return folder_.names().size(); }

 private:
    test::TemporaryFolder folder_;
};

void put(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

std::string get(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A finished run that can be told from others by its mark.
void fill(const RunFolder& folder, const std::string& mark, int exit_code = 0) {
    nlohmann::ordered_json report = {{"mark", mark}, {"files", nlohmann::json::array()}, {"exit_code", exit_code}};
    for (const std::string file : {"mesh.pvtu", "parts/part_0008.part"}) {
        put(folder.file(file), mark);
        report["files"].push_back({{"path", file}});
    }
    put(folder.file("report.json"), sealed(report.dump(2) + "\n"));
}

std::string run(const std::string& path, const std::string& mark, int exit_code = 0) {
    RunFolder folder = RunFolder::create(path);
    fill(folder, mark, exit_code);
    return folder.commit(exit_code == 0);
}

void expect_run(const std::string& path, const std::string& mark) {
    EXPECT_NE(get(path + "/report.json").find("\"mark\": \"" + mark + '"'), std::string::npos);
    EXPECT_EQ(get(path + "/parts/part_0008.part"), mark);
    EXPECT_EQ(get(path + "/mesh.pvtu"), mark);
    EXPECT_EQ(std::distance(fs::directory_iterator(path), fs::directory_iterator()), 3)
        << "files of two runs are mixed";
}

TEST_F(RunFolderTest, AppearsUnderItsNameOnlyWhenCommitted) {
    std::optional<RunFolder> folder = RunFolder::create(path("run"));
    EXPECT_TRUE(fs::is_directory(folder->file("parts")));
    EXPECT_EQ(fs::path(folder->partial_path()).parent_path(), fs::path(path("run")).parent_path());
    fill(*folder, "a");
    EXPECT_FALSE(fs::exists(path("run")));
    folder->commit(true);
    folder.reset();
    expect_run(path("run"), "a");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(RunFolderTest, LeavesNothingWithoutCommit) {
    { fill(RunFolder::create(path("run")), "a"); }
    EXPECT_EQ(entries(), 0u);
    run(path("run"), "old");
    { fill(RunFolder::create(path("run")), "new"); }
    EXPECT_EQ(entries(), 1u);
    expect_run(path("run"), "old");
}

TEST_F(RunFolderTest, ReplacesAnOlderRunAsAWhole) {
    run(path("run"), "old");
    run(path("run"), "new");
    expect_run(path("run"), "new");
    EXPECT_EQ(entries(), 1u);
}

// Also such as this version would not name so.
TEST_F(RunFolderTest, AllFilesOfAnOlderRunGoWithIt) {
    for (int i = 0; i < 100; ++i) {
        RunFolder folder = RunFolder::create(path("run"));
        nlohmann::ordered_json report = {{"files", nlohmann::json::array()}, {"exit_code", 0}};
        for (const std::string file : {"modes.csv", "of_another_version.txt"}) {
            put(folder.file(file), "x");
            report["files"].push_back({{"path", file}});
        }
        put(folder.file("report.json"), sealed(report.dump(2) + "\n"));
        ASSERT_EQ(folder.commit(true), path("run"));
        ASSERT_EQ(entries(), 1u) << "after run " << i + 1;
    }
}

TEST_F(RunFolderTest, UsesAnEmptyFolderAndCreatesTheFoldersAbove) {
    fs::create_directory(path("empty"));
    run(path("empty"), "a");
    expect_run(path("empty"), "a");
    run(path("x/y/run/"), "b");
    expect_run(path("x/y/run"), "b");
}

TEST_F(RunFolderTest, KeepsFoldersAndFilesOfOthers) {
    fs::create_directory(path("thesis"));
    put(path("thesis/chapter"), "years of work");
    put(path("file"), "text");
    for (const std::string name : {"thesis", "file"}) {
        const std::string message = test::io_error([&] { RunFolder::create(path(name)); });
        EXPECT_NE(message.find(path(name)), message.npos) << message;
    }
    EXPECT_EQ(get(path("thesis/chapter")), "years of work");
    EXPECT_EQ(get(path("file")), "text");
    EXPECT_EQ(entries(), 2u);
}

TEST_F(RunFolderTest, KeepsWhatOthersPutThereDuringTheRun) {
    {
        RunFolder folder = RunFolder::create(path("run"));
        fill(folder, "a");
        fs::create_directory(path("run"));
        put(path("run/chapter"), "years of work");
        EXPECT_NE(test::io_error([&] { folder.commit(true); }), "");
    }
    {
        RunFolder folder = RunFolder::create(path("other"));
        fill(folder, "a");
        put(path("other"), "text");
        EXPECT_NE(test::io_error([&] { folder.commit(true); }), "");
    }
    EXPECT_EQ(get(path("run/chapter")), "years of work");
    EXPECT_EQ(get(path("other")), "text");
    EXPECT_EQ(entries(), 2u);
}

// Under any of the names that a run may use, and also when something calls itself a report.
TEST_F(RunFolderTest, AForeignFileIsNamedAndKept) {
    for (const std::string suffix : {"", ".failed", ".kerf-partial", ".kerf-partial-older", ".kerf-partial-removed"})
        for (const std::string file : {"chapter", "parts/notes.txt", "empty/"}) {
            SCOPED_TRACE(suffix + " " + file);
            const std::string folder = path("run" + suffix);
            fs::create_directories(fs::path(folder + "/" + file).parent_path());
            if (!file.ends_with('/')) put(folder + "/" + file, "years of work");
            put(folder + "/report.json", "{}");
            const std::vector<std::string> before = list_files(path(""));
            const std::string message = test::io_error([&] { RunFolder::create(path("run")); });
            EXPECT_NE(message.find(folder), message.npos) << message;
            EXPECT_EQ(list_files(path("")), before);
            fs::remove_all(folder);
        }
    run(path("run"), "old");
    put(path("run/parts/part_0009.part"), "named like a part, but on no list");
    const std::string message = test::io_error([&] { RunFolder::create(path("run")); });
    EXPECT_NE(message.find("parts/part_0009.part"), message.npos) << message;
    fs::remove(path("run/parts/part_0009.part"));
    put(path("run/report.json"), get(path("run/report.json")) + " ");
    EXPECT_NE(test::io_error([&] { RunFolder::create(path("run")); }), "") << "somebody has changed the report";
}

TEST_F(RunFolderTest, AFailedRunLeavesAValidOneAlone) {
    EXPECT_EQ(run(path("run"), "first", 4), path("run")) << "there was none";
    EXPECT_EQ(run(path("run"), "second", 4), path("run"));
    expect_run(path("run"), "second");
    EXPECT_EQ(run(path("run"), "valid"), path("run"));
    EXPECT_EQ(run(path("run"), "third", 4), path("run.failed"));
    EXPECT_EQ(run(path("run"), "fourth", 5), path("run.failed"));
    expect_run(path("run"), "valid");
    expect_run(path("run.failed"), "fourth");
    EXPECT_EQ(entries(), 2u);
}

void expect_failed_run(const std::string& path) {
    EXPECT_EQ(get(path + "/parts/part_0008.part"), "failed");
    EXPECT_EQ(get(path + "/work/journal/8"), "finished");
}

TEST_F(RunFolderTest, FinishedPartsOfAFailedRunAreTakenOver) {
    for (const bool is_beside_valid : {false, true}) {
        SCOPED_TRACE(is_beside_valid);
        if (is_beside_valid) run(path("run"), "valid");
        {
            RunFolder folder = RunFolder::create(path("run"));
            fill(folder, "failed", 4);
            put(folder.journal_file(NodeId(8)), "finished");
            put(folder.saved_run_file(), "options");
            put(folder.job_file(NodeId(9)), "waits");
            const std::string place = folder.commit(false);
            EXPECT_EQ(RunFolder::saved_run_file(path("run")), place + "/work/run.json");
            EXPECT_FALSE(fs::exists(place + "/work/jobs"));
        }
        const std::string place = path(is_beside_valid ? "run.failed" : "run");
        const auto options_are = [](const std::string& text) {
            return [text](const std::string& saved) { return get(saved) == text; };
        };
        { EXPECT_EQ(RunFolder::create(path("run"), options_are("others")).finished_parts(), 0u); }
        expect_failed_run(place);
        RunFolder folder = RunFolder::create(path("run"), options_are("options"));
        EXPECT_EQ(folder.finished_parts(), 1u);
        EXPECT_EQ(get(folder.stored_part_file(NodeId(8))), "failed");
        EXPECT_EQ(get(place + "/report.json").substr(0, 1), "{") << "until the next run is complete";
        fill(folder, "valid");
        folder.commit(true);
        expect_run(path("run"), "valid");
        EXPECT_EQ(entries(), 1u);
    }
}

// A kill right after the rename leaves the work of a valid run, which is whole nevertheless.
TEST_F(RunFolderTest, NothingIsTakenFromAValidRun) {
    run(path("run"), "valid");
    fs::create_directories(path("run/work/journal"));
    put(path("run/work/journal/8"), "finished");
    put(path("run/work/run.json"), "options");
    {
        EXPECT_EQ(RunFolder::create(path("run"), [](const std::string&) { return true; }).finished_parts(), 0u);
    }
    EXPECT_EQ(get(path("run/parts/part_0008.part")), "valid");
    EXPECT_EQ(RunFolder::saved_run_file(path("run")), path("run.kerf-partial/work/run.json"));
}

TEST_F(RunFolderTest, FinishedRunsUnderTheNamesOfOthersStay) {
    run(path("run.failed"), "valid");
    EXPECT_NE(test::io_error([&] { RunFolder::create(path("run")); }), "");
    expect_run(path("run.failed"), "valid");
    run(path("other.kerf-partial"), "valid");
    EXPECT_NE(test::io_error([&] { RunFolder::create(path("other")); }), "");
    expect_run(path("other.kerf-partial"), "valid");
}

// As a kill between two renames leaves it.
TEST_F(RunFolderTest, AnOlderRunThatWasAsideIsPutBack) {
    run(path("run"), "valid");
    fs::rename(path("run"), path("run.kerf-partial-older"));
    EXPECT_EQ(run(path("run"), "failed", 4), path("run.failed"));
    expect_run(path("run"), "valid");
}

// As a kill after both leaves it.
TEST_F(RunFolderTest, AnOlderRunThatWasReplacedIsRemoved) {
    run(path("older"), "older");
    fs::rename(path("older"), path("run.kerf-partial-older"));
    run(path("newer"), "newer");
    fs::rename(path("newer"), path("run"));
    { RunFolder::create(path("run")); }
    EXPECT_FALSE(fs::exists(path("run.kerf-partial-older")));
    expect_run(path("run"), "newer");
}

// Whatever is put among the parts meanwhile is nobody's to remove, and makes no run of Kerf.
TEST_F(RunFolderTest, WhatOthersPutIntoThePartialFolderStays) {
    {
        RunFolder folder = RunFolder::create(path("run"));
        fill(folder, "a");
        put(folder.file("parts/view.pvsm"), "an hour of work");
        folder.keep_only({NodeId(8)});
        folder.commit(true);
    }
    EXPECT_EQ(get(path("run/parts/view.pvsm")), "an hour of work");
    EXPECT_NE(test::io_error([&] { RunFolder::create(path("run")); }).find("parts/view.pvsm"), std::string::npos);
    { RunFolder::create(path("other")); }
    {
        RunFolder folder = RunFolder::create(path("other"));
        put(folder.file("notes.txt"), "an hour of work");
    }
    EXPECT_EQ(get(path("other.kerf-partial-removed/notes.txt")), "an hour of work");
}

TEST_F(RunFolderTest, OneRunAtATimeWrites) {
    run(path("run"), "old");
    {
        RunFolder first = RunFolder::create(path("run"));
        fill(first, "first");
        const std::string message = test::io_error([&] { RunFolder::create(path("run")); });
        EXPECT_NE(message.find("Another run (process " + std::to_string(::getpid())), message.npos) << message;
        run(path("other"), "a");
        EXPECT_EQ(get(first.stored_part_file(NodeId(8))), "first") << "the refused run has changed nothing";
    }
    run(path("run"), "new");
    expect_run(path("run"), "new");
    EXPECT_EQ(entries(), 2u);
}

TEST_F(RunFolderTest, PartsAndJournalOfAnInterruptedRunWaitForTheNext) {
    {
        RunFolder folder = RunFolder::create(path("run"));
        fill(folder, "a");
        for (const NodeId leaf : {NodeId(8), NodeId(9)}) put(folder.journal_file(leaf), "finished");
        put(folder.stored_part_file(NodeId(9)), "part 9");
        put(folder.part_surface_file(NodeId(8)), "surface");
        put(folder.job_file(NodeId(10)), "waits");
        folder.keep();
    }
    EXPECT_FALSE(fs::exists(path("run")));
    { RunFolder::create(path("run")); }  // a run that ends before it begins loses nothing
    RunFolder folder = RunFolder::create(path("run"));
    EXPECT_EQ(folder.finished_parts(), 2u);
    EXPECT_FALSE(fs::exists(folder.job_file(NodeId(10))));
    EXPECT_FALSE(fs::exists(folder.file("report.json")));
    folder.keep_only({NodeId(8), NodeId(10)});
    EXPECT_EQ(get(folder.stored_part_file(NodeId(8))), "a");
    EXPECT_EQ(get(folder.journal_file(NodeId(8))), "finished");
    for (const std::string& stale :
         {folder.stored_part_file(NodeId(9)), folder.journal_file(NodeId(9)), folder.part_surface_file(NodeId(8))})
        EXPECT_FALSE(fs::exists(stale)) << stale;
    fill(folder, "b");
    folder.commit(true);
    expect_run(path("run"), "b");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(RunFolderTest, FollowsALinkToAnOlderRun) {
    run(path("run"), "old");
    fs::create_directory_symlink(path("run"), path("link"));
    run(path("link"), "new");
    EXPECT_TRUE(fs::is_symlink(path("link")));
    expect_run(path("run"), "new");
}

TEST_F(RunFolderTest, FollowsALinkToNothingYet) {
    fs::create_symlink("else/where", path("link"));
    run(path("link"), "a");
    EXPECT_TRUE(fs::is_symlink(path("link")));
    expect_run(path("else/where"), "a");
}

TEST_F(RunFolderTest, OtherRanksWriteIntoTheSameFolder) {
    RunFolder root = RunFolder::create(path("run"));
    fill(root, "a");
    {
        RunFolder other = RunFolder::join(root.partial_path());
        EXPECT_EQ(other.stored_part_file(NodeId(9)), root.stored_part_file(NodeId(9)));
        put(other.stored_part_file(NodeId(9)), "from another rank");
        EXPECT_THROW(other.commit(true), Error);
    }
    root.commit(true);
    EXPECT_EQ(get(path("run/parts/part_0009.part")), "from another rank");
    const std::string message = test::io_error([&] { RunFolder::join(path("nowhere")); });
    EXPECT_NE(message.find(path("nowhere")), message.npos) << message;
}

TEST_F(RunFolderTest, SaysWhyAFolderCannotBeCreated) {
    put(path("file"), "text");
    const std::string message = test::io_error([&] { RunFolder::create(path("file/run")); });
    EXPECT_NE(message.find("Not a directory"), message.npos) << message;
    EXPECT_NE(message.find(path("file")), message.npos) << message;
    EXPECT_NE(test::io_error([] { RunFolder::create(""); }), "");
    EXPECT_NE(test::io_error([] { RunFolder::create("/"); }), "");
}

// Permissions do not bind the super-user, so while this lives such a process is somebody else.
class OrdinaryUser {
 public:
    OrdinaryUser() : user_(::geteuid()) {
        constexpr uid_t nobody = 65534;
        EXPECT_EQ(::seteuid(user_ == 0 ? nobody : user_), 0);
    }
    ~OrdinaryUser() { EXPECT_EQ(::seteuid(user_), 0); }
    OrdinaryUser(const OrdinaryUser&) = delete;
    OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
    uid_t user_;
};

TEST_F(RunFolderTest, SaysThatPermissionsForbidIt) {
    fs::create_directory(path("locked"));
    fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    {
        const OrdinaryUser user;
        const std::string message = test::io_error([&] { RunFolder::create(path("locked/run")); });
        EXPECT_NE(message.find("Permission denied"), message.npos) << message;
    }
    fs::permissions(path("locked"), fs::perms::owner_all);
}

TEST_F(RunFolderTest, NamesPartsByFourDigitsAtLeast) {
    EXPECT_EQ(part_file_name(NodeId(8)), "part_0008.vtu");
    EXPECT_EQ(part_file_name(NodeId(12345)), "12200/part_12345.vtu");
    EXPECT_EQ(part_surface_file_name(NodeId(8)), "part_0008.surface.vtu");
}

}  // namespace
}  // namespace kerf
