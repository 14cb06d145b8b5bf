#include "surface/soup/edge_corners.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

// Facets over few vertices, so that edges have any number of facets and vertices many.
std::vector<Triangle> random_facets(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Triangle> facets(random() % 120);
    const int vertices = 3 + static_cast<int>(random() % 40);
    for (Triangle& t : facets)
        for (std::int32_t& v : t) v = static_cast<std::int32_t>(random() % vertices);
    return facets;
}

TEST(EdgeCorners, AreThoseOfAMap) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        const std::vector<Triangle> facets = random_facets(seed);
        std::vector<std::int32_t> partner(3 * facets.size(), -1);
        std::map<UndirectedEdge, std::vector<std::int32_t>> all, open;
        for (std::int32_t c = 0; c < static_cast<std::int32_t>(partner.size()); ++c) {
            const UndirectedEdge edge = undirected(start_vertex(facets, c), start_vertex(facets, next_corner(c)));
            partner[c] = c % 5 == 0 ? c : -1;
            all[edge].push_back(c);
            if (partner[c] < 0) open[edge].push_back(c);
        }
        for (const bool known : {false, true}) {
            std::vector<std::pair<UndirectedEdge, std::vector<std::int32_t>>> found;
            EdgeCorners(facets, known ? partner : std::vector<std::int32_t>())
                .for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
                    auto& [edge, numbers] = found.emplace_back();
                    edge = {low, corners[0].high};
                    for (const EdgeCorners::Corner& c : corners) numbers.push_back(c.corner);
                });
            const auto& expected = known ? open : all;
            EXPECT_EQ(found, decltype(found)(expected.begin(), expected.end()));
        }
        const std::vector<std::int32_t> across = edge_partners(facets);
        for (const auto& [edge, corners] : all)
            for (std::size_t i = 0; i < corners.size(); ++i)
                EXPECT_EQ(across[corners[i]], corners.size() == 2 ? corners[1 - i] : -1);
    }
}

}  // namespace
}  // namespace kerf
