// A worker that somebody kills: its part is reported and kept as a reproducer, the others are written. A run that
// somebody interrupts ends with its workers and leaves nothing. Limits of time and memory are reported like failures.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/assets.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

std::string read_text(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<pid_t> children_of(pid_t process) {
    const std::string id = std::to_string(process);
    std::istringstream list(read_text("/proc/" + id + "/task/" + id + "/children"));
    return {std::istream_iterator<pid_t>(list), {}};
}

struct Processes {
    pid_t kerf, worker;
};

// The only child of this process and its first worker, once that computes; at most 20 s of waiting.
std::optional<Processes> await_worker() {
    for (int i = 0; i < 2000; ++i) {
        for (const pid_t kerf : children_of(::getpid()))
            for (const pid_t worker : children_of(kerf))
                if (read_text("/proc/" + std::to_string(worker) + "/comm") == "kerf-worker\n") return {{kerf, worker}};
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {};
}

TEST(KilledWorker, IsReportedAndTheOtherPartsAreWritten) {
    const test::TemporaryFolder folder;
    ChildPool pool;
    pool.start(0, KERF_PROGRAM,
               {"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "4", "--workers", "1", "--max-volume",
                "2e-6"},  // about a second for a part
               {}, 120);
    const std::optional<Processes> found = await_worker();
    ASSERT_TRUE(found);
    ASSERT_EQ(::kill(found->worker, SIGKILL), 0);
    const ChildResult result = pool.wait_any()->result;
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("killed by signal 9"), std::string::npos) << result.log;

    const auto report = nlohmann::json::parse(read_text(folder.file("out/report.json")));
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
        EXPECT_NE(read_text(folder.file("out/failed/" + name.str() + ".txt")).find("killed by signal 9"),
                  std::string::npos);
    }
    EXPECT_EQ(failed, 1);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

TEST(KilledWorker, TimeLimitIsReportedAlike) {
    const test::TemporaryFolder folder;
    const ChildResult result = test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "2",
                                               "--max-volume", "2e-7", "--timeout", "0.3"});
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

TEST(CancelledRun, EndsItsWorkersAndLeavesNothing) {
    for (const int signal : {SIGINT, SIGTERM}) {
        SCOPED_TRACE(signal);
        const test::TemporaryFolder folder;
        ChildPool pool;
        pool.start(0, KERF_PROGRAM,
                   {"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "2", "--max-volume", "1e-6"}, {},
                   120);
        const std::optional<Processes> found = await_worker();
        ASSERT_TRUE(found);
        ASSERT_EQ(::kill(found->kerf, signal), 0);
        const ChildResult result = pool.wait_any()->result;
        EXPECT_EQ(result.exit_code, 130) << result.log;
        EXPECT_NE(result.log.find("cancelled"), std::string::npos) << result.log;
        EXPECT_TRUE(folder.names().empty());
        EXPECT_EQ(::kill(found->worker, 0), -1) << "the worker is still there";
    }
}

}  // namespace
}  // namespace kerf
