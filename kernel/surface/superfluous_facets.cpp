// Copies are found by sorting facets by their sorted vertices. With one of each, every edge should have two facets; an
// edge that has three then has one without them. Shells of nothing but copies are found by union-find over the edges.
#include "surface/superfluous_facets.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "core/elements.h"
#include "geometry/union_find.h"
#include "surface/edge_corners.h"

namespace kerf {

namespace {

// Groups of equal facets, single ones included; the first of a group stands for it.
std::vector<std::vector<std::int32_t>> group_equal(const std::vector<Triangle>& facets) {
    std::vector<std::pair<Triangle, std::int32_t>> sorted;
    sorted.reserve(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (has_repeated_vertex(facets[f])) continue;
        sorted.emplace_back(facets[f], static_cast<std::int32_t>(f));
        std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::vector<std::int32_t>> groups;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i == 0 || sorted[i].first != sorted[i - 1].first) groups.emplace_back();
        groups.back().push_back(sorted[i].second);
    }
    return groups;
}

// One facet of every group.
std::vector<Triangle> one_of_each(const std::vector<Triangle>& facets,
                                  const std::vector<std::vector<std::int32_t>>& groups) {
    std::vector<Triangle> single;
    single.reserve(groups.size());
    for (const auto& group : groups) single.push_back(facets[group.front()]);
    return single;
}

// How many facets meet at the edges of each.
std::vector<std::array<std::size_t, 3>> facets_at_edges(const EdgeCorners& edges, std::size_t facet_count) {
    std::vector<std::array<std::size_t, 3>> at(facet_count);
    edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        for (const auto& c : corners) at[c.corner / 3][c.corner % 3] = corners.size();
    });
    return at;
}

std::int32_t number_to_keep(const std::array<std::size_t, 3>& at) {
    const auto all = [&](auto good) { return std::all_of(at.begin(), at.end(), good); };
    if (all([](std::size_t n) { return n == 2; })) return 1;
    return all([](std::size_t n) { return n == 1 || n == 3; }) ? 0 : -1;
}

std::vector<std::int32_t> shells_of(const EdgeCorners& edges, std::size_t facet_count) {
    UnionFind facets(facet_count);
    edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        for (const auto& c : corners) facets.join(corners[0].corner / 3, c.corner / 3);
    });
    return facets.take().of;
}

}  // namespace

SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets) {
    SuperfluousFacets found;
    for (std::size_t f = 0; f < facets.size(); ++f)
        if (has_repeated_vertex(facets[f])) found.repeated_vertex.push_back(static_cast<std::int32_t>(f));
    const auto groups = group_equal(facets);
    if (groups.size() + found.repeated_vertex.size() == facets.size()) return found;

    const EdgeCorners edges(one_of_each(facets, groups));
    const auto at_edges = facets_at_edges(edges, groups.size());
    const std::vector<std::int32_t> shell = shells_of(edges, groups.size());
    std::vector<char> only_copies(groups.size(), 1);
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].size() == 1) only_copies[shell[g]] = 0;
    std::map<std::int32_t, std::int32_t> number;  // of the coincident shells; ordered, and there are few
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].size() == 1) continue;
        FacetCopies& copies = found.copies.emplace_back();
        copies.facets = groups[g];
        copies.keep = number_to_keep(at_edges[g]);
        // A single facet with a copy is a flat pocket, not a body.
        if (!only_copies[shell[g]] || copies.keep == 0) continue;
        const auto [it, is_new] = number.try_emplace(shell[g], static_cast<std::int32_t>(number.size()));
        if (is_new) found.coincident_shells.emplace_back();
        copies.shell = it->second;
        std::vector<std::int32_t>& all = found.coincident_shells[it->second];
        all.insert(all.end(), groups[g].begin(), groups[g].end());
    }
    for (auto& all : found.coincident_shells) std::sort(all.begin(), all.end());
    std::sort(found.copies.begin(), found.copies.end(),
              [](const FacetCopies& a, const FacetCopies& b) { return a.facets[0] < b.facets[0]; });
    return found;
}

}  // namespace kerf
