#include "cut/cut/inside/planar_grid.h"

#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

// Every box that overlaps, each once, for queries of all sizes.
void expect_same_as_brute_force(const std::vector<PlanarBox>& boxes, std::mt19937& random) {
    PlanarGrid grid(boxes);
    std::uniform_real_distribution<double> place(-2, 12), size(0, 6);
    for (int q = 0; q < 100; ++q) {
        const Vec2 low(place(random), place(random));
        const PlanarBox query{low, low + Vec2(size(random), size(random)) * (q % 3)};
        std::vector<int> visits(boxes.size(), 0), expected(boxes.size(), 0);
        grid.for_each_overlap(query, [&](std::int32_t i) { ++visits[i]; });
        for (std::size_t i = 0; i < boxes.size(); ++i) expected[i] = boxes[i].intersects(query);
        ASSERT_EQ(visits, expected) << "query " << q;
    }
}

TEST(PlanarGrid, FindsWhatBruteForceFinds) {
    constexpr unsigned seed = 5;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 10), size(0, 1);
    for (const int count : {1, 2, 10, 500})
        for (const Vec2& scale : {Vec2(1, 1), Vec2(0, 0), Vec2(3, 0), Vec2(1e-3, 5)}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << count << " boxes");
            std::vector<PlanarBox> boxes;
            for (int i = 0; i < count; ++i) {
                const Vec2 low(place(random), place(random));
                boxes.push_back({low, low + scale.cwiseProduct(Vec2(size(random), size(random)))});
            }
            expect_same_as_brute_force(boxes, random);
        }
}

TEST(PlanarGrid, TakesBoxesInALineOrAtOnePlace) {
    std::mt19937 random(6);
    std::vector<PlanarBox> line, place(20, {Vec2(3, 3), Vec2(3, 3)});
    for (int i = 0; i < 50; ++i) line.push_back({Vec2(i * 0.2, 4), Vec2(i * 0.2 + 0.1, 4)});
    expect_same_as_brute_force(line, random);
    expect_same_as_brute_force(place, random);
}

TEST(PlanarGrid, EmptyFindsNothing) {
    PlanarGrid grid({});
    grid.for_each_overlap({Vec2(0, 0), Vec2(1, 1)}, [](std::int32_t) { FAIL(); });
}

}  // namespace
}  // namespace kerf
