#include "surface/diagnosis/superfluous_facets.h"

#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "base/core/elements.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {
namespace {

Triangle ascending(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

std::array<UndirectedEdge, 3> edges_of(const Triangle& t) {
    return {undirected(t[0], t[1]), undirected(t[1], t[2]), undirected(t[2], t[0])};
}

// By maps, as it is defined.
SuperfluousFacets by_definition(const std::vector<Triangle>& facets) {
    SuperfluousFacets found;
    std::map<Triangle, std::vector<std::int32_t>> groups;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(facets.size()); ++f)
        if (has_repeated_vertex(facets[f]))
            found.repeated_vertex.push_back(f);
        else
            groups[ascending(facets[f])].push_back(f);
    std::map<UndirectedEdge, std::vector<std::int32_t>> at_edge;  // one facet of each group
    UnionFind shells(facets.size());
    for (const auto& [t, group] : groups)
        for (const UndirectedEdge& edge : edges_of(t)) {
            at_edge[edge].push_back(group[0]);
            shells.join(at_edge[edge][0], group[0]);
        }
    std::map<std::int32_t, bool> only_copies;
    for (const auto& [t, group] : groups) {
        const bool is_copied = group.size() > 1;
        const auto [it, is_new] = only_copies.try_emplace(shells.root(group[0]), is_copied);
        it->second &= is_copied;
    }
    std::map<std::int32_t, std::int32_t> number;
    for (const auto& [t, group] : groups) {
        if (group.size() == 1) continue;
        FacetCopies& copies = found.copies.emplace_back();
        copies.facets = group;
        int pairs = 0, odd = 0;
        for (const UndirectedEdge& edge : edges_of(t)) {
            pairs += at_edge[edge].size() == 2;
            odd += at_edge[edge].size() == 1 || at_edge[edge].size() == 3;
        }
        copies.keep = pairs == 3 ? 1 : odd == 3 ? 0 : -1;
        const std::int32_t shell = shells.root(group[0]);
        if (!only_copies[shell] || copies.keep == 0) continue;
        copies.shell = number.try_emplace(shell, static_cast<std::int32_t>(number.size())).first->second;
        found.coincident_shells.resize(number.size());
        std::vector<std::int32_t>& all = found.coincident_shells[copies.shell];
        all.insert(all.end(), group.begin(), group.end());
        std::sort(all.begin(), all.end());
    }
    std::sort(found.copies.begin(), found.copies.end(),
              [](const auto& a, const auto& b) { return a.facets < b.facets; });
    return found;
}

void expect_equal(const SuperfluousFacets& found, const SuperfluousFacets& expected) {
    EXPECT_EQ(found.repeated_vertex, expected.repeated_vertex);
    EXPECT_EQ(found.coincident_shells, expected.coincident_shells);
    ASSERT_EQ(found.copies.size(), expected.copies.size());
    for (std::size_t i = 0; i < found.copies.size(); ++i) {
        EXPECT_EQ(found.copies[i].facets, expected.copies[i].facets);
        EXPECT_EQ(found.copies[i].keep, expected.copies[i].keep);
        EXPECT_EQ(found.copies[i].shell, expected.copies[i].shell);
    }
}

// Tetrahedra over few vertices, with facets missing, repeated, turned and degenerate.
std::vector<Triangle> random_tetrahedra(std::mt19937& random) {
    const int vertices = 4 + static_cast<int>(random() % 40);
    std::vector<Triangle> facets;
    for (std::size_t tets = random() % 12; tets > 0; --tets) {
        std::array<std::int32_t, 4> t;
        for (std::int32_t& v : t) v = static_cast<std::int32_t>(random() % vertices);
        const bool is_whole = random() % 4 > 0;
        for (std::size_t copies = 1 + random() % 5 / 3; copies > 0; --copies)
            for (std::size_t i = 0; i < 4; ++i)
                if (is_whole || random() % 2) facets.push_back({t[i], t[(i + 1) % 4], t[(i + 2) % 4]});
    }
    for (std::size_t more = random() % 3; more > 0 && !facets.empty(); --more)
        facets.push_back(facets[random() % facets.size()]);
    std::shuffle(facets.begin(), facets.end(), random);
    return facets;
}

TEST(SuperfluousFacets, AreThoseOfTheDefinition) {
    int shells = 0, kept = 0, left_out = 0, undecided = 0;
    for (unsigned seed = 1; seed <= 2000; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Triangle> facets = random_tetrahedra(random);
        const SuperfluousFacets expected = by_definition(facets);
        expect_equal(find_superfluous_facets(facets, edge_partners(facets)), expected);
        shells += static_cast<int>(expected.coincident_shells.size());
        for (const FacetCopies& copies : expected.copies)
            ++(copies.keep == 1 ? kept : copies.keep == 0 ? left_out : undecided);
    }
    for (const int count : {shells, kept, left_out, undecided}) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace kerf
