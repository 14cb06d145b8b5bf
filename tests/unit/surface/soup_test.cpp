#include "surface/soup/soup.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "surface/soup/vertex_table.h"

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

// Coordinates of all kinds: equal ones are often there, by chance or as 0 and -0.
double coordinate_by_chance(std::mt19937_64& random) {
    constexpr double few[] = {0, -0.0, 1, -1, 4.9e-324, -4.9e-324, 1e300};
    if (random() % 4 != 0) return few[random() % 7];
    return random() % 8 == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(random() % 50) / 7;
}

TEST(WeldExactly, FindsTheFirstOfEqualsForAnyNumbers) {
    std::mt19937_64 random(1);
    for (const std::size_t count : {1U, 15U, 127U, 128U, 129U, 1000U, 30000U}) {
        SCOPED_TRACE(count);
        Soup soup;
        std::vector<Vec3> first;
        std::map<std::array<double, 3>, std::int32_t> number_of;
        std::vector<Triangle> expected;
        for (std::size_t v = 0; v < count; ++v) {
            Vec3 p;
            for (double& x : p) x = coordinate_by_chance(random);
            const auto next = static_cast<std::int32_t>(first.size()), own = static_cast<std::int32_t>(v);
            const std::int32_t number =
                p.hasNaN() ? next : number_of.try_emplace({p.x(), p.y(), p.z()}, next).first->second;
            if (number == next) first.push_back(p);
            soup.vertices.push_back(p);
            soup.facets.push_back({own, own, own});
            expected.push_back({number, number, number});
        }
        EXPECT_EQ(weld_exactly(soup), static_cast<std::int64_t>(count - first.size()));
        EXPECT_EQ(soup.facets, expected);
        ASSERT_EQ(soup.vertices.size(), first.size());
        EXPECT_EQ(std::memcmp(soup.vertices.data(), first.data(), first.size() * sizeof(Vec3)), 0);
    }
}

TEST(VertexTable, GrowsWithoutLosingAnyVertex) {
    std::mt19937 random(2);
    std::vector<Vec3> vertices;
    for (int i = 0; i < 5000; ++i) vertices.emplace_back(i, random() % 3, 0);
    for (const std::size_t expected : {0U, 100U, 5000U}) {
        VertexTable table(expected);
        for (int round = 0; round < 2; ++round)
            for (std::int32_t v = 0; v < 5000; ++v) ASSERT_EQ(table.enter(v, hash_of_point(vertices[v]), vertices), v);
        vertices.push_back(vertices[77]);
        EXPECT_EQ(table.enter(5000, hash_of_point(vertices.back()), vertices), 77);
        vertices.pop_back();
    }
}

TEST(WeldExactly, AcceptsAnEmptySoup) {
    Soup soup;
    EXPECT_EQ(weld_exactly(soup), 0);
}

}  // namespace
}  // namespace kerf
