#include "fill/mesh/buckets.h"

#include <random>
#include <span>

#include <gtest/gtest.h>

namespace kerf {
namespace {

using Filled = std::vector<std::vector<int>>;

// However many items are held at once: every bucket is visited once, in order, with its items in theirs.
TEST(Buckets, AreVisitedInOrderWithAllTheirItems) {
    std::mt19937 random(3);
    for (const std::size_t buckets : {0, 1, 2, 7, 100})
        for (const int count : {0, 1, 50, 1000}) {
            if (buckets == 0 && count > 0) continue;
            Filled expected(buckets);
            std::vector<std::size_t> bucket_of;
            for (int item = 0; item < count; ++item) {
                bucket_of.push_back(random() % buckets % (1 + random() % buckets));  // more in the first ones
                expected[bucket_of.back()].push_back(item);
            }
            for (const std::size_t most : {0, 1, 10, 333, 1000000}) {
                Filled found;
                std::size_t most_at_once = 0, begun = 0;
                const auto for_each_item = [&](const auto& take) {
                    begun = found.size();
                    for (int item = 0; item < count; ++item) take(bucket_of[static_cast<std::size_t>(item)], item);
                };
                visit_buckets<int>(buckets, most, for_each_item, [&](std::size_t bucket, std::span<int> items) {
                    EXPECT_EQ(bucket, found.size());
                    found.emplace_back(items.begin(), items.end());
                    std::fill(items.begin(), items.end(), -1);  // nobody else minds
                    std::size_t at_once = 0;
                    for (std::size_t b = begun; b < found.size(); ++b) at_once += found[b].size();
                    if (begun + 1 < found.size()) most_at_once = std::max(most_at_once, at_once);
                });
                EXPECT_EQ(found, expected) << buckets << " buckets, " << count << " items, " << most;
                EXPECT_LE(most_at_once, most) << "several buckets at once";
            }
        }
}

}  // namespace
}  // namespace kerf
