// What runs on threads gives the same for any number of them, and says what went wrong first.
#include "base/core/threads.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "base/core/out_of_memory.h"
#include "base/core/thread_limit.h"

namespace kerf {
namespace {

class Threads : public testing::TestWithParam<int> {
 protected:
    Threads() { set_thread_limit(GetParam()); }
    ~Threads() override { set_thread_limit(static_cast<int>(std::thread::hardware_concurrency())); }
};
INSTANTIATE_TEST_SUITE_P(Limit, Threads, testing::Values(1, 2, 7));

TEST_P(Threads, EachIndexComesOnce) {
    for (const std::size_t count : {0, 1, 2, 1000}) {
        std::vector<int> calls(count, 0);
        for_each_on_threads(count, [&](std::size_t i) { ++calls[i]; });
        EXPECT_EQ(calls, std::vector<int>(count, 1));
        std::fill(calls.begin(), calls.end(), 0);
        for_ranges_on_threads(count, 7, [&](const IndexRange& range) {
            EXPECT_LE(range.last - range.first, 7U);
            for (std::size_t i = range.first; i < range.last; ++i) ++calls[i];
        });
        EXPECT_EQ(calls, std::vector<int>(count, 1));
    }
}

TEST_P(Threads, SumsDependOnRangesAlone) {
    const auto sum_of = [](const IndexRange& range) {
        double sum = 0;
        for (std::size_t i = range.first; i < range.last; ++i) sum += 1.0 / static_cast<double>(i + 1);
        return sum;
    };
    double expected = 0;
    for (std::size_t i = 0; i < 100'000; i += 1000) expected += sum_of({i, i + 1000});
    const std::vector<double> parts = values_of_ranges(100'000, 1000, sum_of);
    EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), 0.0), expected);
}

TEST_P(Threads, SortsAsOneDoes) {
    std::mt19937_64 random(GetParam());
    for (const std::size_t count : {0, 1, 1000, 500'001}) {
        std::vector<std::uint64_t> items(count);
        for (std::uint64_t& item : items) item = random() % (count + 1);
        std::vector<std::uint64_t> sorted = items;
        std::sort(sorted.begin(), sorted.end());
        sort_on_threads(items);
        EXPECT_EQ(items, sorted);
    }
}

TEST_P(Threads, LoopsMayBeNested) {
    std::vector<int> calls(16 * 16, 0);
    for_each_on_threads(16,
                        [&](std::size_t i) { for_each_on_threads(16, [&](std::size_t j) { ++calls[16 * i + j]; }); });
    EXPECT_EQ(calls, std::vector<int>(16 * 16, 1));
}

// Of two branches one is long: its loops may have the thread that has done the other one.
TEST(Threads, AThreadThatWaitsLendsItsPlace) {
    const ThreadLimitGuard guard;
    set_thread_limit(2);
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (const std::size_t long_one : {0u, 1u}) {
        std::atomic<bool> is_lent = false;
        for_each_on_threads(2, [&](std::size_t i) {
            while (i == long_one && !is_lent && std::chrono::steady_clock::now() < give_up)
                if (detail::spare_threads() > 0) is_lent = true;
        });
        EXPECT_TRUE(is_lent);
        EXPECT_EQ(detail::spare_threads(), 1);
    }
}

TEST_P(Threads, TheFirstExceptionIsThrown) {
    for (int round = 0; round < 50; ++round) {
        const auto fail = [](std::size_t i) {
            if (i >= 3) throw std::runtime_error(std::to_string(i));
        };
        try {
            for_each_on_threads(1000, fail);
            FAIL();
        } catch (const std::runtime_error& e) {
            EXPECT_STREQ(e.what(), "3");
        }
    }
}

TEST(OutOfMemory, ComesInThreeShapes) {
    const auto error = [](std::errc code) { return std::system_error(std::make_error_code(code)); };
    EXPECT_TRUE(is_out_of_memory(std::bad_alloc()));
    EXPECT_TRUE(is_out_of_memory(error(std::errc::resource_unavailable_try_again)));
    EXPECT_TRUE(is_out_of_memory(error(std::errc::not_enough_memory)));
    EXPECT_FALSE(is_out_of_memory(error(std::errc::no_such_file_or_directory)));
    EXPECT_FALSE(is_out_of_memory(std::runtime_error("memory")));
}

TEST(Threads, ALimitOfACallEndsWithIt) {
    const int before = detail::spare_threads();
    for (const int threads : {1, 2, 7}) {
        const ThreadLimitGuard guard;
        set_thread_limit(threads);
        EXPECT_EQ(detail::spare_threads(), threads - 1);
        const ThreadLimitGuard inner;
        set_thread_limit(threads + 1);
    }
    EXPECT_EQ(detail::spare_threads(), before);
    EXPECT_THROW(
        {
            const ThreadLimitGuard guard;
            set_thread_limit(3);
            throw 1;
        },
        int);
    EXPECT_EQ(detail::spare_threads(), before);
}

}  // namespace
}  // namespace kerf
