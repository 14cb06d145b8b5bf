// Facets at vertices of many: which pairs meet, and how many are asked.
#include "surface/diagnosis/inside/facet_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {
namespace {

constexpr int fan_size = FacetTree::least_of_fan;

// Two fans over one rim.
Soup bipyramid(int rim, double height) {
    Soup soup;
    soup.vertices = {Vec3(0, 0, height), Vec3(0, 0, -height)};
    for (int i = 0; i < rim; ++i) {
        const double angle = 2 * std::numbers::pi * i / rim;
        soup.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
        const int next = (i + 1) % rim;
        soup.facets.push_back({0, 2 + i, 2 + next});
        soup.facets.push_back({1, 2 + next, 2 + i});
    }
    return soup;
}

// Facets from one vertex in all directions, or in a plane, of which some cross or lie on others.
void add_random_fan(Soup& soup, int count, bool is_flat, const Vec3& apex, std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    soup.vertices.push_back(apex);
    for (int i = 0; i < count; ++i) {
        const Vec3 to(coordinate(random), coordinate(random), is_flat ? 0 : coordinate(random));
        const Vec3 aside(coordinate(random), coordinate(random), is_flat ? 0 : coordinate(random));
        soup.vertices.push_back(apex + to);
        soup.vertices.push_back(apex + to + 0.02 * aside);
        const auto next = static_cast<std::int32_t>(soup.vertices.size());
        soup.facets.push_back({first, next - 2, next - 1});
    }
}

void add_random_facets(Soup& soup, int count, std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        const Vec3 corner(coordinate(random), coordinate(random), i % 2 == 0 ? 0 : coordinate(random));
        for (int k = 0; k < 3; ++k)
            soup.vertices.push_back(
                corner + 0.3 * Vec3(coordinate(random), coordinate(random), i % 4 == 0 ? 0 : coordinate(random)));
        soup.facets.push_back({first, first + 1, first + 2});
    }
}

// Facets that have the place of the vertex as a corner, on an edge or inside, but not the vertex.
void add_facets_through(Soup& soup, const Vec3& place) {
    const Vec3 u(0.5, 0, 0), v(0, 0.5, 0), w(0, 0, 0.5);
    for (const auto& [a, b, c] : {std::array<Vec3, 3>{place, place + u, place + w},
                                  {place - u, place + u, place + w},
                                  {place - u - v, place + u - v, place + v},
                                  {place - u - w, place + u - w, place + w}}) {
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        soup.vertices.insert(soup.vertices.end(), {a, b, c});
        soup.facets.push_back({first, first + 1, first + 2});
    }
}

IntersectingPairs all_pairs(const Soup& soup) {
    IntersectingPairs pairs;
    const auto corners = [&](const Triangle& t) {
        return std::array{soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]};
    };
    for (std::int32_t f = 0; f < std::ssize(soup.facets); ++f)
        for (std::int32_t g = f + 1; g < std::ssize(soup.facets); ++g)
            if (triangles_intersect(corners(soup.facets[f]), soup.facets[f], corners(soup.facets[g]), soup.facets[g]))
                pairs.emplace_back(f, g);
    return pairs;
}

TEST(FacetTree, FindsWhatMeetsAtVerticesOfMany) {
    for (const unsigned seed : {1, 2, 5, 6}) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup;
        const Vec3 apex = seed % 2 == 0 ? Vec3(0, 0, 0) : Vec3(0.1, 0.2, 1e-3);
        add_random_fan(soup, fan_size, seed % 4 < 2, apex, random);
        if (seed > 4) add_random_fan(soup, fan_size + 50, seed % 3 == 0, Vec3(0.5, 0, 0), random);
        add_random_facets(soup, 150, random);
        add_facets_through(soup, apex);
        if (seed % 3 == 0) soup = test::join(soup, bipyramid(fan_size, 0.5));
        const IntersectingPairs expected = all_pairs(soup);
        ASSERT_GT(expected.size(), 100u);
        EXPECT_EQ(find_self_intersections(soup.vertices, soup.facets, 1'000'000), expected);
        std::vector<char> chosen(soup.facets.size());
        for (char& c : chosen) c = random() % 4 != 0;
        IntersectingPairs of_chosen = expected;
        std::erase_if(of_chosen, [&](const auto& pair) { return !chosen[pair.first] && !chosen[pair.second]; });
        EXPECT_EQ(find_intersections_of(chosen, soup.vertices, soup.facets, 1'000'000), of_chosen);
    }
}

TEST(FacetTree, SharesOfUnitsGiveEachPairOnce) {
    std::mt19937 random(3);
    Soup soup = bipyramid(2 * fan_size, 1);
    add_random_fan(soup, fan_size, false, Vec3(0.2, 0, 0), random);
    add_random_facets(soup, 100, random);
    const SelfIntersectionSearch search(soup.vertices, soup.facets);
    IntersectingPairs all;
    for (std::size_t share = 0; share < 5; ++share) {
        const IntersectingPairs own = search.pairs_of_share(share, 5, 1'000'000);
        all.insert(all.end(), own.begin(), own.end());
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, all_pairs(soup));
}

// All boxes at an apex meet. Flat ones are discs, whose facets are all in one plane.
TEST(FacetTree, AsksFewPairsOfAFan) {
    for (const double height : {1.0, 0.01, 100.0, 0.0})
        for (const int rim : {1000, 8000}) {
            SCOPED_TRACE(height);
            SCOPED_TRACE(rim);
            Soup soup = bipyramid(rim, height);
            if (height == 0) std::erase_if(soup.facets, [](const Triangle& t) { return t[0] == 1; });
            const FacetTree tree(soup.vertices, soup.facets);
            std::int64_t asked = 0;
            tree.any_pair({0, tree.unit_count()}, [&](std::int32_t, std::int32_t) {
                ++asked;
                return false;
            });
            EXPECT_GE(asked, std::ssize(soup.facets)) << "neighbours, at least";
            EXPECT_LE(asked, 20 * std::ssize(soup.facets));
            EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
        }
}

}  // namespace
}  // namespace kerf
