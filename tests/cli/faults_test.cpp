// What may happen during a night: workers that are killed, hang or grow, full disks, other runs into the same folder.
// Each has its exit code and its message; nothing that looks whole is not, no process stays, and what can go on does.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

// About half a second for a part.
std::vector<std::string> four_parts(const std::string& output) {
    return {"mesh", test::asset_path("cube"), "-o", output, "-n", "4", "--workers", "1", "--max-volume", "4e-6"};
}

TEST(KilledWorker, IsReportedAndTheOtherPartsAreWritten) {
    const test::TemporaryFolder folder;
    test::StartedRun run(KERF_PROGRAM, four_parts(folder.file("out")));
    ASSERT_TRUE(test::await([&] { return !run.workers().empty(); }));
    ASSERT_EQ(::kill(run.workers().front(), SIGKILL), 0);
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("killed by signal 9"), std::string::npos) << result.log;

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
        EXPECT_NE(part.dump().find("killed by signal 9"), std::string::npos) << part.dump();
        EXPECT_NE(test::bytes_of_file(folder.file("out/failed/" + name.str() + ".txt")).find("killed by signal 9"),
                  std::string::npos);
    }
    EXPECT_EQ(failed, 1);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

TEST(KilledWorker, TimeLimitIsReportedAlike) {
    const test::TemporaryFolder folder;
    const ChildResult result = test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "2",
                                               "--max-volume", "2e-7", "--timeout", "0.3", "--attempts", "2"});
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("ran longer than its 0.3 s"), std::string::npos) << result.log;
}

TEST(MemoryLimit, IsReportedWithItsOwnCode) {
    const test::TemporaryFolder folder;
    const ChildResult result = test::run_kerf({"mesh", test::asset_path("bearing_cap_14k"), "-o", folder.file("out"),
                                               "-n", "2", "--max-volume", "0.05", "--memory", "250"});
    EXPECT_EQ(result.exit_code, 5) << result.log;
    EXPECT_NE(result.log.find("memory"), std::string::npos) << result.log;
    EXPECT_TRUE(std::filesystem::exists(folder.file("out/failed/part_0002.smesh")));
}

TEST(HangingWorker, IsStoppedAndItsPartTriedAgain) {
    const test::TemporaryFolder folder;
    std::vector<std::string> arguments = four_parts(folder.file("out"));
    arguments.insert(arguments.end(), {"--timeout", "8"});
    test::StartedRun run(KERF_PROGRAM, arguments);
    ASSERT_TRUE(test::await([&] { return !run.workers().empty(); }));
    ASSERT_EQ(::kill(run.workers().front(), SIGSTOP), 0);
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("another order of the vertices"), std::string::npos) << result.log;
    EXPECT_NE(test::bytes_of_file(folder.file("out/report.json")).find("ran longer than its 8 s"), std::string::npos);
}

TEST(SecondRun, IntoTheSameFolderIsRefused) {
    const test::TemporaryFolder folder;
    test::StartedRun run(KERF_PROGRAM, four_parts(folder.file("out")));
    ASSERT_TRUE(test::await([&] { return !run.workers().empty(); }));
    const ChildResult second = test::run_kerf(four_parts(folder.file("out")));
    EXPECT_EQ(second.exit_code, 7);
    EXPECT_NE(second.log.find("Another run (process " + std::to_string(run.process())), std::string::npos)
        << second.log;
    EXPECT_EQ(run.wait().exit_code, 0);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

// As on a disk that becomes full: no file may grow beyond 1 MB, which surfaces and jobs of the parts do not need.
TEST(FullDisk, EndsTheRunAndSpaceLetsItGoOn) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf(four_parts(folder.file("whole"))).exit_code, 0);
    std::string script = "trap '' XFSZ; ulimit -f 2000; exec '" KERF_PROGRAM "'";
    for (const std::string& argument : four_parts(folder.file("out"))) script += " '" + argument + "'";
    const ChildResult full = test::run_program("/bin/sh", {"-c", script});
    EXPECT_EQ(full.exit_code, 7) << full.log;
    EXPECT_NE(full.log.find("part_"), std::string::npos) << full.log;
    EXPECT_NE(full.log.find("File too large"), std::string::npos) << full.log;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"out.kerf-partial", "whole"}));
    const ChildResult resumed = test::run_kerf({"mesh", "--resume", folder.file("out")});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.log;
    EXPECT_TRUE(test::contents(folder.file("out/parts")) == test::contents(folder.file("whole/parts")));
}

// A file system of 2 MB, where a process may mount one of its own.
TEST(FullDisk, OfAFileSystemOfItsOwn) {
    const test::TemporaryFolder folder;
    if (test::run_program("/usr/bin/unshare", {"--map-root-user", "--mount", "true"}).exit_code != 0)
        return;  // the test above needs no such permission
    std::string script = "mount -t tmpfs -o size=2m none '" + folder.file("") + "' && '" KERF_PROGRAM "'";
    for (const std::string& argument : four_parts(folder.file("out"))) script += " '" + argument + "'";
    script += "; echo \"code=$?\"; ls '" + folder.file("") + "'";
    const ChildResult full =
        test::run_program("/usr/bin/unshare", {"--map-root-user", "--mount", "/bin/sh", "-c", script});
    EXPECT_EQ(test::output_of(full), "code=7\nout.kerf-partial\n") << full.log;
    EXPECT_NE(full.log.find("No space left on device"), std::string::npos) << full.log;
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
                                               "part", "number", "end"}));
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
    const std::string to_descriptor = "'" KERF_PROGRAM "' mesh '" + test::asset_path("hollow_box") + "' -q -o '" +
                                      folder.file("out") + "' --events fd:5 5>&1";
    const ChildResult descriptor = test::run_program("/bin/sh", {"-c", to_descriptor});
    EXPECT_EQ(descriptor.exit_code, 0) << descriptor.log;
    EXPECT_NE(test::output_of(descriptor).find("\"event\":\"end\""), std::string::npos);
}

}  // namespace
}  // namespace kerf
