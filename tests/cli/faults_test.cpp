// What may happen during a night: workers that are killed or grow, full disks, other runs into the same folder.
// Each has its exit code and its message; nothing that looks whole is not, no process stays, and what can go on does.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/slice.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

// About half a second for a part.
std::vector<std::string> four_parts(const std::string& output) {
    return {"mesh", test::asset_path("cube"), "-o", output, "-n", "4", "--workers", "1", "--max-volume", "4e-6"};
}

// Kills the worker of the first part, and the one that takes its place, so many times.
void kill_workers(const test::StartedRun& run, int times) {
    std::vector<pid_t> killed;
    for (int i = 0; i < times; ++i) {
        std::vector<pid_t> workers;
        ASSERT_TRUE(test::await([&] {
            workers = run.workers();
            return !workers.empty() && std::find(killed.begin(), killed.end(), workers.front()) == killed.end();
        }));
        ASSERT_EQ(::kill(workers.front(), i % 2 == 0 ? SIGKILL : SIGTERM), 0);
        killed.push_back(workers.front());
    }
}

TEST(KilledWorker, IsStartedOnceMoreForTheSameBytes) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf(four_parts(folder.file("undisturbed"))).exit_code, 0);
    test::StartedRun run(test::kerf_program(), four_parts(folder.file("out")));
    ASSERT_NO_FATAL_FAILURE(kill_workers(run, 1));
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("1 part again after the worker was killed"), std::string::npos) << result.log;
    EXPECT_NE(test::bytes_of_file(folder.file("out/report.json")).find("killed by signal 9"), std::string::npos);
    EXPECT_TRUE(test::contents(folder.file("out/parts")) == test::contents(folder.file("undisturbed/parts")));
}

// The run that goes on needs only that part.
TEST(KilledWorker, KilledAgainItsPartFailsAndTheOthersAreKept) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf(four_parts(folder.file("undisturbed"))).exit_code, 0);
    test::StartedRun run(test::kerf_program(), four_parts(folder.file("out")));
    ASSERT_NO_FATAL_FAILURE(kill_workers(run, 2));
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("killed by signal 15"), std::string::npos) << result.log;
    EXPECT_NE(result.log.find("kerf mesh --resume " + folder.file("out")), std::string::npos) << result.log;

    const auto report = nlohmann::json::parse(test::bytes_of_file(folder.file("out/report.json")));
    EXPECT_EQ(report["exit_code"], 4);
    EXPECT_FALSE(report["verification"]["passed"]);
    int failed = 0;
    for (const auto& part : report["parts"]) {
        std::ostringstream name;
        name << "part_" << std::setw(4) << std::setfill('0') << part["id"].get<int>();
        const bool written = std::filesystem::exists(folder.file("out/parts/" + name.str() + ".vtu"));
        const bool kept = std::filesystem::exists(folder.file("out/failed/" + name.str() + ".smesh"));
        EXPECT_NE(written, kept) << name.str();
        if (!kept) continue;
        ++failed;
        EXPECT_NE(part.dump().find("killed by signal 15"), std::string::npos) << part.dump();
        EXPECT_NE(test::bytes_of_file(folder.file("out/failed/" + name.str() + ".txt")).find("killed by signal 15"),
                  std::string::npos);
    }
    EXPECT_EQ(failed, 1);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"out", "undisturbed"}));

    const ChildResult resumed = test::run_kerf({"mesh", "--resume", folder.file("out")});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.log;
    EXPECT_NE(resumed.log.find("3 parts were finished by an interrupted run"), std::string::npos) << resumed.log;
    EXPECT_TRUE(test::contents(folder.file("out/parts")) == test::contents(folder.file("undisturbed/parts")));
    EXPECT_EQ(test::run_kerf({"verify", folder.file("out")}).exit_code, 0);
}

TEST(KilledWorker, AFailedRunDoesNotReplaceAValidOne) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf(four_parts(folder.file("out"))).exit_code, 0);
    const auto before = test::contents_below(folder.file("out"));
    test::StartedRun run(test::kerf_program(), four_parts(folder.file("out")));
    ASSERT_NO_FATAL_FAILURE(kill_workers(run, 2));
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("keeps the older run, which is valid"), std::string::npos) << result.log;
    EXPECT_TRUE(test::contents_below(folder.file("out")) == before);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"out", "out.failed"}));
    EXPECT_EQ(test::run_kerf({"mesh", "--resume", folder.file("out")}).exit_code, 0);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

TEST(MissingWorker, IsSaidBeforeTheWork) {
    const test::TemporaryFolder folder;
    std::filesystem::copy_file(test::kerf_program(), folder.file("kerf"));
    const ChildResult result =
        test::run_program(folder.file("kerf"), {"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "2"});
    EXPECT_EQ(result.exit_code, 7) << result.log;
    EXPECT_NE(result.log.find("kerf-worker"), std::string::npos) << result.log;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"kerf"});
}

TEST(KilledWorker, TimeLimitIsReportedAlike) {
    const test::TemporaryFolder folder;
    const ChildResult result = test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "2",
                                               "--max-volume", "2e-7", "--timeout", "0.3", "--attempts", "2"});
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("ran longer than its 0.3 s"), std::string::npos) << result.log;
}

// TetGen hangs twice.
TEST(KilledWorker, WhatTetGenDoesNotEndInTimeIsTheLatticesAndSaid) {
    const test::TemporaryFolder folder;
    const auto whole_by = [&](const std::string& mesher, const std::string& output) {
        return std::vector<std::string>{"mesh",         test::asset_path("cube"),
                                        "-o",           folder.file(output),
                                        "-n",           "1",
                                        "--max-volume", "6e-6",
                                        "--mesher",     mesher,
                                        "-j",           "1",
                                        "--timeout",    test::is_sanitized() ? "20" : "3"};
    };
    ASSERT_EQ(test::run_kerf(whole_by("lattice", "lattice")).exit_code, 0);
    test::StartedRun run(test::kerf_program(), whole_by("tetgen", "out"));
    const pid_t first = run.stop_worker();
    ASSERT_GT(first, 0);
    ASSERT_TRUE(test::await([&] { return test::has_ended(first); }));
    ASSERT_GT(run.stop_worker(), 0);
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("part 1: the lattice mesher"), std::string::npos) << result.log;
    EXPECT_NE(result.log.find("1 part after a time-out"), std::string::npos) << result.log;
    const auto report = nlohmann::json::parse(test::bytes_of_file(folder.file("out/report.json")));
    EXPECT_EQ(report["parts"][0]["remedy"], "the lattice mesher");
    EXPECT_EQ(report["parts"][0]["attempts"], 3);
    EXPECT_TRUE(test::contents(folder.file("out/parts")) == test::contents(folder.file("lattice/parts")));
}

TEST(MemoryLimit, IsReportedWithItsOwnCode) {
    const test::TemporaryFolder folder;
    const ChildResult result =
        test::run_kerf({"mesh", test::asset_path("bearing_cap_14k"), "-o", folder.file("out"), "-n", "2",
                        "--max-volume", "0.05", "--memory", "200", "--mesher", "tetgen"});
    EXPECT_EQ(result.exit_code, 5) << result.log;
    EXPECT_NE(result.log.find("memory"), std::string::npos) << result.log;
    EXPECT_TRUE(std::filesystem::exists(folder.file("out/failed/part_0002.smesh")));
}

// An interface of a million triangles takes some seconds. A run that does not notice the signal is ended within two
// seconds, and says so; on a machine that gives it less than half of that, one that does may be ended, too.
TEST(Cancelling, EndsACutInTheMiddle) {
    const test::TemporaryFolder folder;
    for (const double seconds : {0.3, 1.2, 2.5}) {
        test::StartedRun run(test::kerf_program(),
                             {"decompose", test::asset_path("hollow_box"), "-o", folder.file("out"), "-n", "32",
                              "--size", "0.002", "--surface", "split"});
        const auto computed = [&] { return test::seconds_computed(run.process()); };
        ASSERT_TRUE(test::await([&] { return computed() >= seconds; }));
        const double before = computed();
        ASSERT_EQ(::kill(run.process(), SIGTERM), 0);
        ASSERT_TRUE(test::await([&] { return test::has_ended(run.process()); }));
        const double to_the_end = computed() - before;
        const ChildResult result = run.wait();
        EXPECT_EQ(result.exit_code, 130);
        if (test::is_sanitized()) continue;  // sanitizers may be too slow to end in order
        const bool in_order = result.log.find("The run was cancelled.") != std::string::npos;
        EXPECT_TRUE(in_order || to_the_end < 1) << to_the_end << " s: " << result.log;
        EXPECT_TRUE(!in_order || folder.names().empty());
        std::filesystem::remove_all(folder.file("out.kerf-partial"));
    }
}

TEST(SecondRun, IntoTheSameFolderIsRefused) {
    const test::TemporaryFolder folder;
    test::StartedRun run(test::kerf_program(), four_parts(folder.file("out")));
    const pid_t worker = run.stop_worker();
    ASSERT_GT(worker, 0);
    const ChildResult second = test::run_kerf(four_parts(folder.file("out")));
    EXPECT_EQ(second.exit_code, 7);
    EXPECT_NE(second.log.find("Another run (process " + std::to_string(run.process())), std::string::npos)
        << second.log;
    ASSERT_EQ(::kill(worker, SIGCONT), 0);
    EXPECT_EQ(run.wait().exit_code, 0);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

// The run beside a merged file goes when that is there; what is nobody's but the user's does not.
TEST(MergedFile, LeavesWhatOthersPutIntoItsRun) {
    const test::TemporaryFolder folder;
    test::StartedRun run(test::kerf_program(), four_parts(folder.file("out.msh")));
    const pid_t worker = run.stop_worker();
    ASSERT_GT(worker, 0);
    std::ofstream(folder.file("out.msh.kerf-run.kerf-partial/notes.txt")) << "an hour of work";
    ASSERT_EQ(::kill(worker, SIGCONT), 0);
    EXPECT_EQ(run.wait().exit_code, 0);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"out.msh", "out.msh.kerf-run"}));
    EXPECT_EQ(test::bytes_of_file(folder.file("out.msh.kerf-run/notes.txt")), "an hour of work");
    EXPECT_FALSE(std::filesystem::exists(folder.file("out.msh.kerf-run/parts")));
}

// As on a disk that becomes full: no file may grow beyond 1 MB, which surfaces and jobs of the parts do not need.
TEST(FullDisk, EndsTheRunAndSpaceLetsItGoOn) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf(four_parts(folder.file("whole"))).exit_code, 0);
    const auto run_full = [&] {
        std::string script = "ulimit -f 2000; exec '" + test::kerf_program() + "'";
        for (const std::string& argument : four_parts(folder.file("out"))) script += " '" + argument + "'";
        ChildResult full = test::run_program("/bin/sh", {"-c", script});
        EXPECT_EQ(full.exit_code, 7) << full.log;
        EXPECT_NE(full.log.find("part_"), std::string::npos) << full.log;
        EXPECT_NE(full.log.find("File too large"), std::string::npos) << full.log;
        return full;
    };
    run_full();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"whole"}) << "nothing was finished";
    test::StartedRun run(test::kerf_program(), four_parts(folder.file("out")));
    ASSERT_TRUE(test::await([&] { return test::finished_parts(folder.file("out")) >= 2; }));
    ASSERT_GT(run.stop_worker(), 0);
    ASSERT_EQ(::kill(run.process(), SIGTERM), 0);
    EXPECT_EQ(run.wait().exit_code, 130);
    const ChildResult full = run_full();
    EXPECT_NE(full.log.find("parts are finished; kerf mesh --resume"), std::string::npos) << full.log;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"out.kerf-partial", "whole"}));
    const ChildResult resumed = test::run_kerf({"mesh", "--resume", folder.file("out")});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.log;
    EXPECT_TRUE(test::contents(folder.file("out/parts")) == test::contents(folder.file("whole/parts")));
}

// Parts are stored in fewer bytes than they are written in: all of them are finished when the first file is too large.
TEST(FullDisk, IsNoReasonToMeshAgainWhatIsFinished) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf(four_parts(folder.file("whole"))).exit_code, 0);
    std::uintmax_t smallest = std::numeric_limits<std::uintmax_t>::max();
    for (const int part : {4, 5, 6, 7})
        smallest = std::min(smallest,
                            std::filesystem::file_size(folder.file(fmt::format("whole/parts/part_{:04}.vtu", part))));
    std::string script = fmt::format("ulimit -f {}; exec '{}'", smallest / 512 * 9 / 10, test::kerf_program());
    for (const std::string& argument : four_parts(folder.file("out"))) script += " '" + argument + "'";
    const ChildResult full = test::run_program("/bin/sh", {"-c", script});
    EXPECT_EQ(full.exit_code, 7) << full.log;
    EXPECT_NE(full.log.find("All 4 parts are finished; kerf mesh --resume " + folder.file("out") + " writes"),
              std::string::npos)
        << full.log;
    EXPECT_EQ(test::run_kerf({"mesh", "--resume", folder.file("out")}).exit_code, 0);
    const ChildResult again = test::run_kerf({"mesh", "--resume", folder.file("out")});
    EXPECT_EQ(again.exit_code, 0) << again.log;
    EXPECT_NE(test::output_of(again).find("nothing waits"), std::string::npos) << test::output_of(again);
}

// A file system of its own, where a process may mount one: too small for a mesh of about 13 MB, or by far
// too small.
TEST(FullDisk, OfAFileSystemOfItsOwn) {
    const test::TemporaryFolder folder;
    if (test::run_program("/usr/bin/unshare", {"--map-root-user", "--mount", "true"}).exit_code != 0)
        GTEST_SKIP() << "no permission to mount a file system; the test above needs none";
    const auto run_in = [&](const std::string& megabytes) {
        std::string script = "mount -t tmpfs -o size=" + megabytes + "m none '" + folder.file("") + "' && '" +
                             test::kerf_program() + "'";
        for (const std::string& argument : four_parts(folder.file("out"))) script += " '" + argument + "'";
        script += "; echo \"code=$?\"; ls '" + folder.file("") + "'";
        return test::run_program("/usr/bin/unshare", {"--map-root-user", "--mount", "/bin/sh", "-c", script});
    };
    const ChildResult full = run_in("11");
    EXPECT_EQ(test::output_of(full), "code=7\nout.kerf-partial\n") << full.log;
    EXPECT_NE(full.log.find("No space left on device"), std::string::npos) << full.log;
    EXPECT_NE(full.log.find("kerf mesh --resume"), std::string::npos) << full.log;
    const ChildResult hopeless = run_in("2");
    EXPECT_EQ(test::output_of(hopeless), "code=5\n") << hopeless.log;
    EXPECT_NE(hopeless.log.find("whose files take"), std::string::npos) << hopeless.log;
}

TEST(EventsFile, TellsOfEveryPartAndTheEnd) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf({"mesh", test::asset_path("hollow_box"), "-o", folder.file("out"), "-n", "3", "--events",
                              folder.file("events")})
                  .exit_code,
              0);
    std::ifstream file(folder.file("events"));
    std::vector<std::string> kinds;
    std::int64_t tets = 0;
    double seconds = 0;
    for (std::string line; std::getline(file, line);) {
        const auto event = nlohmann::json::parse(line);
        if (kinds.empty()) {
            EXPECT_EQ(event["input"], test::asset_path("hollow_box"));
            EXPECT_EQ(event["output"], folder.file("out"));
            EXPECT_EQ(event["trace"], "");
            EXPECT_EQ(event["parts"], 3);
        }
        kinds.push_back(event["event"] == "stage" ? event["stage"] : event["event"]);
        EXPECT_GE(event["seconds"].get<double>(), seconds);
        seconds = event["seconds"];
        if (event["event"] == "part") tets += event["tets"].get<std::int64_t>();
        if (event["event"] == "part") {
            EXPECT_EQ(event["tets_done"], tets);
        }
    }
    EXPECT_EQ(kinds, (std::vector<std::string>{"run", "read", "decompose", "prepare", "parts", "volume", "part", "part",
                                               "part", "write", "hash", "end"}));
    const auto report = nlohmann::json::parse(test::bytes_of_file(folder.file("out/report.json")));
    EXPECT_EQ(report["totals"]["tets"], tets);
    const ChildResult unwritable = test::run_kerf(
        {"mesh", test::asset_path("hollow_box"), "-o", folder.file("out"), "--events", folder.file("no/events")});
    EXPECT_EQ(unwritable.exit_code, 7);
    EXPECT_NE(unwritable.log.find("no/events"), std::string::npos) << unwritable.log;
    const ChildResult full =
        test::run_kerf({"mesh", test::asset_path("hollow_box"), "-o", folder.file("out"), "--events", "/dev/full"});
    EXPECT_EQ(full.exit_code, 7);
    EXPECT_NE(full.log.find("/dev/full: No space left"), std::string::npos) << full.log;
    EXPECT_EQ(test::run_kerf({"mesh", test::asset_path("hollow_box"), "-o", folder.file("out"), "--events", "fd:99"})
                  .exit_code,
              7);
    const ChildResult inside = test::run_kerf(
        {"mesh", test::asset_path("hollow_box"), "-o", folder.file("out"), "--events", folder.file("out/events")});
    EXPECT_EQ(inside.exit_code, 2) << inside.log;
    // A reader that leaves has seen enough.
    const ChildResult left = test::run_program(
        "/bin/sh", {"-c", "('" + test::kerf_program() + "' mesh '" + test::asset_path("hollow_box") + "' -q -o '" +
                              folder.file("out") + "' --events fd:5; echo code=$? >&2) 5>&1 | head -1"});
    EXPECT_NE(left.log.find("code=0"), std::string::npos) << left.log;
    const std::string to_descriptor = "'" + test::kerf_program() + "' mesh '" + test::asset_path("hollow_box") +
                                      "' -q -o '" + folder.file("out") + "' --events fd:5 5>&1";
    const ChildResult descriptor = test::run_program("/bin/sh", {"-c", to_descriptor});
    EXPECT_EQ(descriptor.exit_code, 0) << descriptor.log;
    EXPECT_NE(test::output_of(descriptor).find("\"event\":\"end\""), std::string::npos);
}

}  // namespace
}  // namespace kerf
