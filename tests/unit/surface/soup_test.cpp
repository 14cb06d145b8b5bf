#include "surface/soup.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

// Vertices on a small lattice, so that many coincide.
Soup random_lattice_soup(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coordinate(-2, 2);
    Soup soup;
    for (std::int32_t f = 0; f < 100; ++f) {
        for (int i = 0; i < 3; ++i) soup.vertices.emplace_back(coordinate(random), coordinate(random), 0);
        soup.facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return soup;
}

TEST(WeldExactly, KeepsEveryCornerAndLeavesNoEqualVertices) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE(seed);
        const Soup before = random_lattice_soup(seed);
        Soup after = before;
        const std::int64_t removed = weld_exactly(after);
        EXPECT_EQ(removed, static_cast<std::int64_t>(before.vertices.size() - after.vertices.size()));
        EXPECT_GT(removed, 0);
        for (std::size_t f = 0; f < before.facets.size(); ++f)
            for (int i = 0; i < 3; ++i)
                ASSERT_EQ(before.vertices[before.facets[f][i]], after.vertices[after.facets[f][i]]);
        for (std::size_t v = 0; v < after.vertices.size(); ++v)
            for (std::size_t w = v + 1; w < after.vertices.size(); ++w) ASSERT_NE(after.vertices[v], after.vertices[w]);
        EXPECT_EQ(weld_exactly(after), 0);
    }
}

TEST(WeldExactly, KeepsTheOrderOfFirstOccurrence) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const Soup before = random_lattice_soup(seed);
        Soup after = before;
        weld_exactly(after);
        std::vector<Vec3> expected;
        for (const Vec3& p : before.vertices)
            if (std::find(expected.begin(), expected.end(), p) == expected.end()) expected.push_back(p);
        EXPECT_EQ(after.vertices, expected);
    }
}

TEST(WeldExactly, TakesMinusZeroForZeroAndNothingForNan) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Soup soup;
    soup.vertices = {Vec3(0, 0, 1), Vec3(-0.0, 0, 1), Vec3(nan, 0, 0), Vec3(nan, 0, 0), Vec3(0, 0, 1 + 1e-15)};
    soup.facets = {{0, 2, 4}, {1, 3, 4}};
    EXPECT_EQ(weld_exactly(soup), 1);
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 3}, {0, 2, 3}}));
}

TEST(WeldExactly, AcceptsAnEmptySoup) {
    Soup soup;
    EXPECT_EQ(weld_exactly(soup), 0);
}

}  // namespace
}  // namespace kerf
