#include "fill/volume/child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/core/error.h"

namespace kerf {
namespace {

using End = ChildResult::End;

Bytes pattern(std::size_t size) {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 2654435761u >> 13);
    return bytes;
}

std::string text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

void start_shell(ChildPool& pool, int tag, const std::string& script, Bytes input = {}, double timeout = 0) {
    pool.start(tag, "/bin/sh", {"-c", script}, std::move(input), timeout);
}

ChildResult run_shell(const std::string& script, Bytes input = {}, double timeout = 0) {
    ChildPool pool;
    start_shell(pool, 7, script, std::move(input), timeout);
    const auto finished = pool.wait_any();
    EXPECT_EQ(finished->tag, 7);
    EXPECT_EQ(pool.running(), 0u);
    return finished->result;
}

TEST(ChildProcess, EchoesInputOfAnySize) {
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{65537}, std::size_t{10'000'000}}) {
        SCOPED_TRACE(size);
        ChildPool pool;
        pool.start(1, "/bin/cat", {}, pattern(size), 0);
        const ChildResult result = pool.wait_any()->result;
        EXPECT_EQ(result.end, End::exited);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_TRUE(result.output == pattern(size));
        EXPECT_EQ(result.log, "");
        EXPECT_GT(result.peak_rss_bytes, 0);
    }
}

TEST(ChildProcess, PassesArgumentsUnchanged) {
    ChildPool pool;
    pool.start(1, "/bin/sh", {"-c", "printf '%s|' \"$@\"", "name", "a b", "", "\"$HOME\" *"}, {}, 0);
    EXPECT_EQ(text(pool.wait_any()->result.output), "a b||\"$HOME\" *|");
}

TEST(ChildProcess, ReportsExitCode) {
    for (const int code : {0, 1, 4, 130, 255}) {
        SCOPED_TRACE(code);
        const ChildResult result = run_shell("exit " + std::to_string(code));
        EXPECT_EQ(result.end, End::exited);
        EXPECT_EQ(result.exit_code, code);
        EXPECT_EQ(result.describe(), "ended with exit code " + std::to_string(code));
    }
}

TEST(ChildProcess, ReportsSignal) {
    for (const int signal : {SIGSEGV, SIGKILL, SIGTERM, SIGPIPE}) {
        SCOPED_TRACE(signal);
        const ChildResult result = run_shell("kill -" + std::to_string(signal) + " $$");
        EXPECT_EQ(result.end, End::signalled);
        EXPECT_EQ(result.signal, signal);
    }
    EXPECT_EQ(run_shell("kill -9 $$").describe(), "was killed by signal 9 (Killed)");
}

TEST(ChildProcess, StopsAtTheTimeLimit) {
    const ChildResult result = run_shell("echo begun; exec sleep 30", {}, 0.2);
    EXPECT_EQ(result.end, End::timed_out);
    EXPECT_EQ(result.describe(), "ran longer than its 0.2 s and was stopped");
    EXPECT_EQ(text(result.output), "begun\n");
    EXPECT_GE(result.seconds, 0.2);
}

TEST(ChildProcess, LimitHoldsForOneThatWritesWithoutEnd) {
    EXPECT_EQ(run_shell("exec yes", {}, 0.1).end, End::timed_out);
}

TEST(ChildProcess, KeepsTheEndOfTheLog) {
    const ChildResult result = run_shell("yes 123456789 | head -n 10000 >&2; printf end >&2; printf out");
    EXPECT_EQ(result.log.size(), 4096u);
    EXPECT_EQ(result.log.substr(4096 - 13), "123456789\nend");
    EXPECT_EQ(text(result.output), "out");
}

TEST(ChildProcess, SurvivesOneThatNeverReads) {
    const ChildResult early = run_shell("exit 3", pattern(10'000'000));
    EXPECT_EQ(early.exit_code, 3);
    const ChildResult closed = run_shell("exec <&-; sleep 0.05; exit 4", pattern(10'000'000));
    EXPECT_EQ(closed.exit_code, 4);
    EXPECT_EQ(run_shell("exec sleep 30", pattern(10'000'000), 0.1).end, End::timed_out);
}

TEST(ChildProcess, WaitsForOneThatClosesItsStreams) {
    const ChildResult result = run_shell("exec >&- 2>&-; sleep 0.1; exit 5");
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_GE(result.seconds, 0.1);
}

TEST(ChildProcess, DoesNotWaitForGrandchildren) {
    // The background process keeps the pipes open; it ends by itself, so that the test leaves nothing behind.
    const ChildResult result = run_shell("sleep 2 & echo $!; exit 6");
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_EQ(kill(std::stoi(text(result.output)), SIGKILL), 0) << "the grandchild ended before its parent was reaped";
}

TEST(ChildProcess, RunsSeveralAtOnce) {
    ChildPool pool;
    constexpr int count = 8;
    for (int i = 0; i < count; ++i) start_shell(pool, i, "cat; exit " + std::to_string(i), pattern(300'000 + i));
    EXPECT_EQ(pool.running(), static_cast<std::size_t>(count));
    std::vector<int> tags;
    while (pool.running() > 0) {
        const auto finished = pool.wait_any();
        ASSERT_TRUE(finished);
        tags.push_back(finished->tag);
        EXPECT_EQ(finished->result.exit_code, finished->tag);
        EXPECT_TRUE(finished->result.output == pattern(300'000 + finished->tag));
    }
    std::sort(tags.begin(), tags.end());
    EXPECT_EQ(tags, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(ChildProcess, ReturnsTheFirstToEnd) {
    ChildPool pool;
    start_shell(pool, 1, "exec sleep 30");
    start_shell(pool, 2, "exit 0");
    EXPECT_EQ(pool.wait_any()->tag, 2);
    EXPECT_EQ(pool.running(), 1u);
}

TEST(ChildProcess, WaitEndsWithoutAResult) {
    ChildPool pool;
    start_shell(pool, 1, "exec sleep 30");
    EXPECT_FALSE(pool.wait_any(0));
    EXPECT_FALSE(pool.wait_any(0.05));
    EXPECT_EQ(pool.running(), 1u);
}

TEST(ChildProcess, InheritsNoOtherFile) {
    const int null = open("/dev/null", O_RDONLY);  // without O_CLOEXEC
    ASSERT_GE(null, 0);
    ChildPool pool;
    start_shell(pool, 1, "exec cat");  // its pipes are open here, too
    // The shell itself opens one more, to list the folder.
    const std::string listing = text(run_shell("cd /proc/$$/fd && echo *").output);
    close(null);
    EXPECT_EQ(listing.substr(0, 5), "0 1 2");
    EXPECT_LE(std::count(listing.begin(), listing.end(), ' '), 3) << listing;
}

TEST(ChildProcess, MissingProgramIsAnError) {
    ChildPool pool;
    try {
        pool.start(1, "/nowhere/kerf-worker", {}, pattern(100), 0);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io);
        EXPECT_NE(std::string(error.what()).find("/nowhere/kerf-worker"), std::string::npos) << error.what();
    }
    EXPECT_EQ(pool.running(), 0u);
}

TEST(ChildProcess, InterruptsOneOfThem) {
    ChildPool pool;
    start_shell(pool, 1, "exec sleep 30");
    start_shell(pool, 2, "exec sleep 30");
    pool.interrupt(3);  // there is none
    pool.interrupt(2);
    const auto finished = pool.wait_any();
    EXPECT_EQ(finished->tag, 2);
    EXPECT_EQ(finished->result.end, End::signalled);
    EXPECT_EQ(finished->result.signal, SIGINT);
    EXPECT_EQ(pool.running(), 1u);
}

TEST(ChildProcess, DestructorKillsWhatStillRuns) {
    const std::string path = testing::TempDir() + "kerf_child_pid_" + std::to_string(getpid());
    {
        ChildPool pool;
        start_shell(pool, 1, "echo $$ > " + path + "; exec >&-; exec sleep 30");
        start_shell(pool, 2, "while [ ! -s " + path + " ]; do sleep 0.01; done");
        ASSERT_EQ(pool.wait_any()->tag, 2);
    }
    pid_t pid = 0;
    std::ifstream(path) >> pid;
    unlink(path.c_str());
    ASSERT_GT(pid, 0);
    EXPECT_EQ(kill(pid, 0), -1);
    EXPECT_EQ(errno, ESRCH);
}

TEST(ChildProcess, LeavesTheSignalMaskAlone) {
    run_shell("exec <&-", pattern(1'000'000));
    sigset_t mask, pending;
    pthread_sigmask(SIG_BLOCK, nullptr, &mask);
    sigpending(&pending);
    EXPECT_EQ(sigismember(&mask, SIGPIPE), 0);
    EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
}

}  // namespace
}  // namespace kerf
