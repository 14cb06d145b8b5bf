// A rank that is killed, out of memory, or deaf while another one fails: all ranks end, one speaks, no process stays.
#include <sys/resource.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/mpirun.h"
#include "support/places.h"
#include "support/slice.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using test::await;

// A run of three ranks, whose stages are known from the log of its events.
class MpiFailures : public testing::Test {
 protected:
    void start() {
        std::vector<std::string> words = test::mpirun_arguments(3);
        for (const std::string& word : {test::kerf_program(), std::string("mesh"), test::asset_path("cube"),
                                        std::string("-o"), folder_.file("out"), std::string("-n"), std::string("9"),
                                        std::string("--max-volume"), std::string("4e-6"), std::string("--workers"),
                                        std::string("1"), std::string("--events"), folder_.file("events")})
            words.push_back(word);
        run_ = std::make_unique<test::StartedRun>("/usr/bin/env", words);
    }
    // Waits for the stage, which may be over then, and returns the ranks; none if the run has ended.
    std::vector<pid_t> ranks_at(const std::string& stage) const {
        const std::string words = "\"stage\":\"" + stage + "\"";
        const auto is_there = [&] {
            return std::filesystem::exists(folder_.file("events")) &&
                   test::bytes_of_file(folder_.file("events")).find(words) != std::string::npos;
        };
        EXPECT_TRUE(await([&] { return is_there() || test::has_ended(run_->process()); }));
        return test::descendants_of(run_->process(), "kerf");
    }
    ChildResult end_of(const std::vector<pid_t>& ranks) {
        const std::vector<pid_t> workers = run_->workers();
        EXPECT_TRUE(await([&] { return test::has_ended(run_->process()); })) << "it hangs";
        if (!test::has_ended(run_->process()))
            for (const pid_t rank : ranks) ::kill(rank, SIGKILL);
        ChildResult result = run_->wait();
        for (const std::vector<pid_t>& all : {ranks, workers})
            for (const pid_t process : all) EXPECT_TRUE(await([&] { return test::has_ended(process); })) << "an orphan";
        std::filesystem::remove(folder_.file("events"));
        return result;
    }

    test::TemporaryFolder folder_;
    std::unique_ptr<test::StartedRun> run_;
};

TEST_F(MpiFailures, AKilledRankEndsTheOthersInEachStage) {
    std::size_t victim = 0;
    for (const std::string& stage : test::slice(std::vector<std::string>{"prepare", "volume", "write"}, {"volume"})) {
        SCOPED_TRACE(stage);
        start();
        const std::vector<pid_t> ranks = ranks_at(stage);
        const bool was_killed = ranks.size() == 3 && ::kill(ranks[victim++ % 3], SIGKILL) == 0;
        const ChildResult result = end_of(ranks);
        EXPECT_TRUE(was_killed || stage == "write") << "too late";
        if (stage == "volume") {
            EXPECT_NE(result.exit_code, 0);
        }
    }
}

// The rank finds none for what it needs next: for itself, or for a worker that it starts.
TEST_F(MpiFailures, ARankWithoutMemoryEndsTheOthers) {
    for (const std::size_t victim : {0u, 2u}) {
        SCOPED_TRACE(victim);
        start();
        const std::vector<pid_t> ranks = ranks_at("volume");
        ASSERT_EQ(ranks.size(), 3u);
        const rlimit none{1, 1};
        ASSERT_EQ(::prlimit(ranks[victim], RLIMIT_AS, &none, nullptr), 0);
        const ChildResult result = end_of(ranks);
        EXPECT_TRUE(result.exit_code == 5 || result.exit_code == 7) << result.exit_code << result.log;
        EXPECT_EQ(test::count(result.log, "kerf: "), 1) << result.log;
    }
}

// Nobody answers the one that has failed; it ends alone, and mpirun ends the others.
TEST_F(MpiFailures, ADeafRankDoesNotKeepTheOthers) {
    start();
    const std::vector<pid_t> ranks = ranks_at("volume");
    ASSERT_EQ(ranks.size(), 3u);
    ASSERT_EQ(::kill(ranks[2], SIGSTOP), 0);
    std::filesystem::rename(folder_.file("out.kerf-partial/work/journal"), folder_.file("elsewhere"));
    const ChildResult result = end_of(ranks);
    EXPECT_EQ(result.exit_code, 7) << result.log;
    EXPECT_NE(result.log.find("work/journal/"), std::string::npos) << result.log;
}

}  // namespace
}  // namespace kerf
