#include "base/geometry/union_find.h"

#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

TEST(UnionFind, NumbersSetsBySmallestItem) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::size_t count = 1 + random() % 50;
        UnionFind sets(count);
        std::vector<std::size_t> label(count);  // the smallest item of the set
        std::iota(label.begin(), label.end(), std::size_t{0});
        for (std::size_t i = random() % count; i-- > 0;) {
            const std::size_t a = random() % count, b = random() % count;
            sets.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
            const auto [low, high] = std::minmax({label[a], label[b]});
            std::replace(label.begin(), label.end(), high, low);
        }
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_EQ(sets.root(static_cast<std::int32_t>(i)), static_cast<std::int32_t>(label[i]));
        const Components components = sets.take();
        std::int32_t next = 0;
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_EQ(components.of[i], label[i] == i ? next++ : components.of[label[i]]);
        EXPECT_EQ(components.count, next);
    }
}

}  // namespace
}  // namespace kerf
