// Shares of processors, for masks as mpirun, batch systems and taskset make them.
#include "base/parallel/processors.h"

#include <sched.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <thread>

#include <gtest/gtest.h>

namespace kerf {
namespace {

std::vector<int> range(int first, int last) {
    std::vector<int> numbers(last - first);
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
}

std::vector<int> shares(const std::vector<std::vector<int>>& allowed) {
    std::vector<int> shares;
    for (std::size_t i = 0; i < allowed.size(); ++i) shares.push_back(share_of_processors(allowed, i));
    return shares;
}

TEST(AllowedProcessors, AreThoseOfTheSystem) {
    cpu_set_t set;
    ASSERT_EQ(::sched_getaffinity(0, sizeof set, &set), 0);
    const std::vector<int> allowed = allowed_processors();
    EXPECT_EQ(allowed.size(), static_cast<std::size_t>(CPU_COUNT(&set)));
    for (const int processor : allowed) EXPECT_TRUE(CPU_ISSET(processor, &set));
    EXPECT_TRUE(std::is_sorted(allowed.begin(), allowed.end()));
}

TEST(AllowedProcessors, FollowABinding) {
    std::vector<int> allowed;
    std::thread bound([&] {  // threads have sets of their own
        cpu_set_t set;
        CPU_ZERO(&set);
        CPU_SET(allowed_processors().back(), &set);
        ASSERT_EQ(::sched_setaffinity(0, sizeof set, &set), 0);
        allowed = allowed_processors();
    });
    bound.join();
    EXPECT_EQ(allowed, std::vector<int>{allowed_processors().back()});
}

TEST(AllowedProcessors, OfNoProcessAreNone) { EXPECT_TRUE(allowed_processors(-1).empty()); }

TEST(ShareOfProcessors, OfUnboundProcessesIsTheirPart) {
    for (const int processors : {1, 2, 6, 32, 2000})
        for (int processes = 1; processes <= 7; ++processes)
            EXPECT_EQ(shares(std::vector(processes, range(0, processors))),
                      std::vector(processes, std::max(1, processors / processes)))
                << processors << " processors, " << processes << " processes";
}

TEST(ShareOfProcessors, OfProcessesBoundApartIsWhatTheyAreBoundTo) {
    EXPECT_EQ(shares({range(0, 1), range(1, 2), range(2, 16)}), (std::vector{1, 1, 14}));
    EXPECT_EQ(shares({range(0, 16), range(0, 16), range(16, 32)}), (std::vector{8, 8, 16})) << "two sockets";
    EXPECT_EQ(shares({range(0, 3), range(2, 5)}), (std::vector{2, 2})) << "half of what they share, rounded down";
    EXPECT_EQ(shares({{}, range(0, 2)}), (std::vector{1, 2})) << "where the system tells of none";
}

// Together no more than there are, but for those that would have less than one; more processors never make it less.
TEST(ShareOfProcessors, AddsUpToTheProcessors) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::vector<std::vector<int>> allowed(1 + random() % 6);
        for (std::vector<int>& processors : allowed)
            for (int i = 0; i < 24; ++i)
                if (random() % 3 == 0) processors.push_back(i);
        std::set<int> all;
        int sum = 0;
        for (std::size_t i = 0; i < allowed.size(); ++i) {
            all.insert(allowed[i].begin(), allowed[i].end());
            const int share = share_of_processors(allowed, i);
            EXPECT_LE(share, std::max<std::size_t>(1, allowed[i].size()));
            sum += share == 1 ? 0 : share;
            auto wider = allowed;
            wider[i].push_back(24);
            EXPECT_GE(share_of_processors(wider, i), share);
        }
        EXPECT_LE(sum, static_cast<int>(all.size()));
    }
}

}  // namespace
}  // namespace kerf
