// An interrupted run loses no more than the parts under way, and its end is that of an undisturbed run, to the byte.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/run_folder.h"
#include "support/all_formats.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/slice.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class Resume : public testing::Test {
 protected:
    using Files = std::map<std::string, std::string>;

    // The run that nobody disturbs is made once.
    static void SetUpTestSuite() {
        undisturbed_ = std::make_unique<test::TemporaryFolder>();
        ASSERT_EQ(test::run_kerf(words(test::asset_path("cube"), undisturbed_->file("out"), true)).exit_code, 0);
    }
    static void TearDownTestSuite() { undisturbed_.reset(); }
    static Files undisturbed_in_all_formats() { return test::result_of_run(undisturbed_->file("out")); }
    static Files undisturbed() {
        Files files = undisturbed_in_all_formats();
        std::erase_if(files, [](const auto& file) { return file.first.starts_with("export/"); });
        return files;
    }

    // About a third of a second for each of six parts, by the mesher that takes longer.
    static std::vector<std::string> words(const std::string& input, const std::string& output, bool all_formats) {
        std::vector<std::string> words = {"mesh",         input,  "-o",       output,   "-n",        "6",
                                          "--max-volume", "6e-6", "--mesher", "tetgen", "--workers", "1"};
        if (all_formats) words.insert(words.end(), {"--format", test::all_formats()});
        return words;
    }
    std::vector<std::string> command(const std::string& output, bool all_formats = false) const {
        return words(input_, folder_.file(output), all_formats);
    }
    Files files_of(const std::string& output) const { return test::result_of_run(folder_.file(output)); }

    // Starts a run and ends it by the signal when two parts are finished and a third is under way, whose worker does
    // nothing more by itself.
    ChildResult interrupt(int signal, const std::string& output = "out", bool all_formats = false) const {
        test::StartedRun run(test::kerf_program(), command(output, all_formats));
        EXPECT_TRUE(test::await([&] { return test::finished_parts(folder_.file(output)) >= 2; }));
        const pid_t worker = run.stop_worker();
        EXPECT_GT(worker, 0);
        EXPECT_EQ(::kill(run.process(), signal), 0);
        EXPECT_TRUE(test::await([&] { return test::has_ended(worker); }));
        ChildResult result = run.wait();
        EXPECT_FALSE(fs::exists(folder_.file(output)));
        return result;
    }
    ChildResult resume(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"mesh", "--resume", folder_.file("out")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::run_kerf(arguments);
    }
    std::size_t resumed_parts() const {
        std::size_t count = 0;
        const auto report = nlohmann::json::parse(test::bytes_of_file(folder_.file("out/report.json")));
        for (const auto& part : report["parts"]) count += part.contains("resumed") ? 1 : 0;
        return count;
    }
    // As the journal of the interrupted run names it.
    std::string some_finished_leaf() const {
        std::vector<std::string> leaves;
        for (const auto& entry : fs::directory_iterator(folder_.file("out.kerf-partial/work/journal")))
            leaves.push_back(entry.path().filename());
        return *std::min_element(leaves.begin(), leaves.end());
    }
    static void damage_middle(const fs::path& file) {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(static_cast<std::streamoff>(fs::file_size(file) / 2));
        const char byte = static_cast<char>(stream.peek() ^ 0x10);
        stream.seekp(stream.tellg());
        stream.put(byte);
    }

    inline static std::unique_ptr<test::TemporaryFolder> undisturbed_;
    test::TemporaryFolder folder_;
    std::string input_ = test::asset_path("cube");
};

TEST_F(Resume, GivesTheBytesOfAnUndisturbedRun) {
    const auto expected = undisturbed_in_all_formats();
    for (const auto& [signal, workers] : {std::pair(SIGINT, "1"), {SIGTERM, "2"}, {SIGKILL, "2"}}) {
        SCOPED_TRACE(signal);
        const ChildResult interrupted = interrupt(signal, "out", true);
        if (signal != SIGKILL) {
            EXPECT_EQ(interrupted.exit_code, 130) << interrupted.log;
            EXPECT_NE(interrupted.log.find("parts are finished; kerf mesh --resume " + folder_.file("out")),
                      std::string::npos)
                << interrupted.log;
        }
        const ChildResult result = resume({"--workers", workers});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        EXPECT_GE(resumed_parts(), 2u);
        EXPECT_TRUE(files_of("out") == expected);
        EXPECT_EQ(folder_.names(), std::vector<std::string>{"out"});
        EXPECT_FALSE(fs::exists(folder_.file("out/work")));
        EXPECT_EQ(test::run_kerf({"verify", folder_.file("out")}).exit_code, 0);
        fs::remove_all(folder_.file("out"));
    }
}

// All parts are meshed, and some files of some formats are there.
TEST_F(Resume, WritesTheFormatsThatAreMissing) {
    const auto expected = undisturbed_in_all_formats();
    test::StartedRun run(test::kerf_program(), command("out", true));
    EXPECT_TRUE(test::await([&] { return fs::exists(folder_.file("out.kerf-partial/export")); }));
    EXPECT_EQ(::kill(run.process(), SIGKILL), 0);
    run.wait();
    ASSERT_FALSE(fs::exists(folder_.file("out"))) << "the run was faster than the signal";
    const ChildResult result = resume();
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_EQ(resumed_parts(), 6u);
    EXPECT_TRUE(files_of("out") == expected);
}

// The store of a part goes when its file is written: that has all of it again, if it is whole.
TEST_F(Resume, APartWhoseStoreHasGoneIsTakenFromItsFile) {
    const auto expected = undisturbed();
    for (const bool is_whole : {true, false}) {
        SCOPED_TRACE(is_whole);
        interrupt(SIGKILL);
        const std::size_t finished = test::finished_parts(folder_.file("out"));
        const NodeId leaf(std::stoi(some_finished_leaf()));
        const fs::path parts = folder_.file("out.kerf-partial/parts"), file = parts / part_file_name(leaf);
        fs::remove(parts / stored_part_file_name(leaf));
        fs::copy_file(undisturbed_->file("out/parts/" + part_file_name(leaf)), file);
        if (!is_whole) damage_middle(file);
        const ChildResult result = resume();
        EXPECT_EQ(result.exit_code, 0) << result.log;
        EXPECT_EQ(resumed_parts(), is_whole ? finished : finished - 1);
        EXPECT_TRUE(files_of("out") == expected);
        fs::remove_all(folder_.file("out"));
    }
}

// The folder that a user sees after an interruption.
TEST_F(Resume, TakesThePartialFolderForTheRunIntoIt) {
    interrupt(SIGTERM);
    const std::size_t finished = test::finished_parts(folder_.file("out"));
    for (const char* name : {"out.kerf-partial", "out.kerf-partial/"})
        EXPECT_EQ(test::run_kerf({"mesh", "--resume", folder_.file(name), "--dry-run"}).exit_code, 0) << name;
    EXPECT_EQ(test::run_kerf({"mesh", "--resume", folder_.file("out.kerf-partial/")}).exit_code, 0);
    EXPECT_EQ(resumed_parts(), finished);
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"out"});
}

TEST_F(Resume, TheSameCommandFindsWhatIsFinishedToo) {
    const auto expected = undisturbed();
    interrupt(SIGKILL);
    const ChildResult result = test::run_kerf(command("out"));
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("were finished by an interrupted run"), std::string::npos) << result.log;
    EXPECT_GE(resumed_parts(), 2u);
    EXPECT_TRUE(files_of("out") == expected);
}

// Without -n K follows from the machine, but not where parts of an interrupted run wait.
TEST_F(Resume, TheSameCommandOnAnotherMachineHasTheSameParts) {
    interrupt(SIGKILL);
    const ChildResult result = test::run_kerf(
        {"mesh", input_, "-o", folder_.file("out"), "--max-volume", "6e-6", "--mesher", "tetgen", "--workers", "3"});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_GE(resumed_parts(), 2u);
}

TEST_F(Resume, AnInterruptedRunMayBeMoved) {
    const auto expected = undisturbed();
    interrupt(SIGTERM, "before");
    fs::rename(folder_.file("before.kerf-partial"), folder_.file("out.kerf-partial"));
    EXPECT_EQ(resume().exit_code, 0);
    EXPECT_GE(resumed_parts(), 2u);
    EXPECT_TRUE(files_of("out") == expected);
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"out"});
}

// As Ctrl-C in a terminal: the workers get the signal, too.
TEST_F(Resume, ASignalToAllProcessesFailsNoPart) {
    test::StartedRun run("/bin/sh", {"-c", "setsid --wait '" + test::kerf_program() + "' \"$@\"", "sh", "mesh", input_,
                                     "-o", folder_.file("out"), "-n", "6", "--max-volume", "6e-6", "--workers", "1",
                                     "--events", folder_.file("events")});
    ASSERT_TRUE(test::await([&] { return test::finished_parts(folder_.file("out")) >= 2 && !run.workers().empty(); }));
    const std::vector<pid_t> programs = test::descendants_of(run.process(), "kerf");
    ASSERT_EQ(programs.size(), 1u);
    ASSERT_EQ(::kill(-programs.front(), SIGINT), 0) << "to the group";
    EXPECT_EQ(run.wait().exit_code, 130);
    EXPECT_EQ(test::bytes_of_file(folder_.file("events")).find("failed"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_.file("out.kerf-partial/failed")));
    EXPECT_EQ(resume().exit_code, 0);
}

// A worker hangs, so that its part becomes another one in the second attempt.
TEST_F(Resume, APartThatATimeLimitHasShapedIsSaidAndNotTakenOverUnderAnotherLimit) {
    const auto expected = undisturbed();
    const std::string limit = test::is_sanitized() ? "20" : "4";
    std::vector<std::string> arguments = command("out");
    arguments.insert(arguments.end(), {"--timeout", limit});
    test::StartedRun run(test::kerf_program(), arguments);
    ASSERT_TRUE(test::await([&] { return !run.workers().empty(); }));
    ASSERT_EQ(::kill(run.workers().front(), SIGSTOP), 0);
    ASSERT_TRUE(test::await([&] { return test::finished_parts(folder_.file("out")) >= 1; }));
    ASSERT_EQ(::kill(run.process(), SIGTERM), 0);
    EXPECT_EQ(run.wait().exit_code, 130);
    fs::copy(folder_.file("out.kerf-partial"), folder_.file("same.kerf-partial"), fs::copy_options::recursive);
    const std::size_t finished = test::finished_parts(folder_.file("out"));

    const ChildResult other = resume({"--timeout", "600"});
    EXPECT_EQ(other.exit_code, 0) << other.log;
    EXPECT_EQ(resumed_parts(), finished - 1);
    EXPECT_EQ(other.log.find("time-out"), std::string::npos) << other.log;
    EXPECT_TRUE(files_of("out") == expected);

    const ChildResult same = test::run_kerf({"mesh", "--resume", folder_.file("same")});
    EXPECT_EQ(same.exit_code, 0) << same.log;
    EXPECT_NE(same.log.find("after a time-out"), std::string::npos) << same.log;
    EXPECT_NE(same.log.find("another order of the vertices"), std::string::npos) << same.log;
    const std::string report = test::bytes_of_file(folder_.file("same/report.json"));
    EXPECT_NE(report.find(fmt::format("ran longer than its {} s", limit)), std::string::npos);
    EXPECT_NE(report.find("may differ from those of an undisturbed run"), std::string::npos);
    EXPECT_FALSE(files_of("same") == expected);
}

// Other options by mistake do not cost the work that is done, and nothing of it gets into a run with others.
TEST_F(Resume, ARunWithOtherOptionsIsRefusedUntilTheInterruptedOneIsGone) {
    const auto coarse = [&](const std::string& output) {
        return std::vector<std::string>{"mesh", input_, "-o", folder_.file(output), "-n", "4"};
    };
    ASSERT_EQ(test::run_kerf(coarse("coarse")).exit_code, 0);
    interrupt(SIGKILL);
    const ChildResult refused = test::run_kerf(coarse("out"));
    EXPECT_EQ(refused.exit_code, 2) << refused.log;
    EXPECT_NE(refused.log.find("of an interrupted run, which differs in "), std::string::npos) << refused.log;
    EXPECT_NE(refused.log.find("--resume"), std::string::npos) << refused.log;
    const ChildResult resumed = test::run_kerf({"mesh", "--resume", folder_.file("out")});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.log;
    EXPECT_GT(resumed_parts(), 0u);
    fs::remove_all(folder_.file("out"));
    interrupt(SIGKILL);
    fs::remove_all(folder_.file("out.kerf-partial"));
    const ChildResult result = test::run_kerf(coarse("out"));
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_EQ(resumed_parts(), 0u);
    EXPECT_TRUE(files_of("out") == files_of("coarse"));
    EXPECT_FALSE(fs::exists(folder_.file("out/work")));
}

TEST_F(Resume, DamagedJournalsAndPartsAreMeshedAgain) {
    const auto expected = undisturbed();
    const std::vector<std::pair<std::string, void (*)(const fs::path&)>> damages = {
        {"work/journal", damage_middle},
        {"work/journal", [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }},
        {"work/journal", [](const fs::path& file) { fs::resize_file(file, 0); }},
        {"parts", damage_middle},
        {"parts", [](const fs::path& file) { fs::remove(file); }}};
    interrupt(SIGKILL);
    const std::size_t finished = test::finished_parts(folder_.file("out"));
    const fs::path partial = folder_.file("out.kerf-partial"), kept = folder_.file("kept");
    fs::rename(partial, kept);
    for (const auto& [sub_folder, damage] : damages) {
        SCOPED_TRACE(sub_folder);
        fs::copy(kept, partial, fs::copy_options::recursive);
        const std::string leaf = some_finished_leaf();
        damage(folder_.file("out.kerf-partial/" + sub_folder + "/" +
                            (sub_folder == "parts" ? stored_part_file_name(NodeId(std::stoi(leaf))) : leaf)));
        EXPECT_EQ(resume().exit_code, 0);
        EXPECT_EQ(resumed_parts(), finished - 1);
        EXPECT_TRUE(files_of("out") == expected);
        fs::remove_all(folder_.file("out"));
    }
}

// The finished parts are those of the first body.
TEST_F(Resume, AnotherInputOfTheSameNameIsRefused) {
    fs::copy_file(input_, folder_.file("body.stl"));
    input_ = folder_.file("body.stl");
    interrupt(SIGTERM);
    fs::copy_file(test::asset_path("hollow_box"), input_, fs::copy_options::overwrite_existing);
    const ChildResult other = resume();
    EXPECT_EQ(other.exit_code, 7);
    EXPECT_NE(other.log.find("is not the file that the interrupted run has read"), std::string::npos) << other.log;
    EXPECT_GE(test::finished_parts(folder_.file("out")), 2u);
}

// As when a build of the same version replaces the programs meanwhile.
TEST_F(Resume, PartsOfAnotherBuildAreMeshedAgain) {
    interrupt(SIGTERM);
    const std::string programs = folder_.file("programs");
    fs::create_directory(programs);
    fs::copy_file(test::kerf_program(), programs + "/kerf");
    fs::copy_file(test::worker_program(), programs + "/kerf-worker");
    std::ofstream(programs + "/kerf-worker", std::ios::app) << "x";
    const ChildResult result = test::run_program(programs + "/kerf", {"mesh", "--resume", folder_.file("out")});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_EQ(resumed_parts(), 0u);
}

TEST_F(Resume, SaysWhatIsMissing) {
    const ChildResult nothing = resume();
    EXPECT_EQ(nothing.exit_code, 7);
    EXPECT_NE(nothing.log.find("No interrupted run waits for"), std::string::npos) << nothing.log;
    EXPECT_TRUE(folder_.names().empty());

    fs::copy_file(input_, folder_.file("cube.stl"));
    input_ = folder_.file("cube.stl");
    interrupt(SIGTERM);
    fs::rename(input_, folder_.file("elsewhere.stl"));
    const ChildResult removed = resume();
    EXPECT_EQ(removed.exit_code, 7);
    EXPECT_NE(removed.log.find("cube.stl: the file cannot be read"), std::string::npos) << removed.log;
    EXPECT_GE(test::finished_parts(folder_.file("out")), 2u) << "what is finished still waits";
    fs::rename(folder_.file("elsewhere.stl"), input_);

    const ChildResult other = resume({"--max-volume", "1e-3"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.log.find("--max-volume would change the parts"), std::string::npos) << other.log;
    EXPECT_EQ(resume({"-o", folder_.file("new")}).exit_code, 2);
    EXPECT_EQ(resume({"--config", folder_.file("any")}).exit_code, 2);
    EXPECT_EQ(resume({"--dry-run"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(folder_.file("out")));

    fs::resize_file(folder_.file("out.kerf-partial/work/run.json"), 10);
    const ChildResult damaged = resume();
    EXPECT_EQ(damaged.exit_code, 7);
    EXPECT_NE(damaged.log.find("run.json is damaged"), std::string::npos) << damaged.log;
    EXPECT_EQ(test::run_kerf(command("out")).exit_code, 0);
    EXPECT_GE(resumed_parts(), 2u);
}

}  // namespace
}  // namespace kerf
