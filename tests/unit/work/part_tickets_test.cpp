// Laws of the order in which parts are taken.
#include "run/work/part_tickets.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

constexpr std::int32_t hosts = 5;

// In descending order of load, which differ by up to so much.
std::vector<WaitingPart> random_parts(std::size_t size, double most_load, std::mt19937& random) {
    std::uniform_real_distribution<double> load(1, most_load);
    std::uniform_int_distribution<std::int32_t> host(0, hosts - 1);
    std::vector<WaitingPart> parts(size);
    for (WaitingPart& part : parts) part = {load(random), host(random)};
    std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.load > b.load; });
    return parts;
}

TEST(PartTickets, EachPartIsTakenOnceAndNoLongOneWaitsForMuchShorterOnes) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<WaitingPart> parts = random_parts(50 * seed, seed % 2 ? 1.1 : 20, random);
        PartTickets tickets(parts);
        std::vector<char> is_taken(parts.size(), 0);
        std::int64_t own = 0;
        for (std::size_t done = 0; done < parts.size(); ++done) {
            const auto host = static_cast<std::int32_t>(random() % (hosts + 1));  // the last one has none
            const auto part = tickets.take(host);
            ASSERT_TRUE(part);
            ASSERT_FALSE(is_taken[*part]);
            const auto longest = std::find(is_taken.begin(), is_taken.end(), 0) - is_taken.begin();
            const double enough = PartTickets::nearly_as_long * parts[longest].load;
            EXPECT_GE(parts[*part].load, enough);
            for (std::size_t i = 0; i < *part; ++i)
                if (!is_taken[i] && parts[i].host == host) ADD_FAILURE() << "a longer one of its own waits";
            const bool is_own = parts[*part].host == host;
            own += is_own;
            for (std::size_t i = 0; i < parts.size() && !is_own; ++i)
                EXPECT_FALSE(!is_taken[i] && parts[i].host == host && parts[i].load >= enough) << "own ones come first";
            if (!is_own) {
                EXPECT_EQ(*part, static_cast<std::size_t>(longest));
            }
            is_taken[*part] = 1;
        }
        EXPECT_GT(own, static_cast<std::int64_t>(parts.size()) / hosts);
        EXPECT_FALSE(tickets.take(0));
        EXPECT_FALSE(tickets.take(hosts));
    }
}

TEST(PartTickets, OfOneHostAreInTheOrderOfTheList) {
    std::vector<WaitingPart> parts(9, {2, 0});
    parts.resize(20, {1, 0});
    PartTickets tickets(parts);
    for (std::size_t i = 0; i < parts.size(); ++i) EXPECT_EQ(tickets.take(0), i);
    EXPECT_FALSE(PartTickets({}).take(0));
}

}  // namespace
}  // namespace kerf
