// A facet with a copy has none but edges of many facets, or of two that are copies. Those that may have one are sorted
// by their sorted vertices. With one of each, every edge should have two facets; an edge that has three then has one
// without them. Shells of nothing but copies are found by union-find over the edges.
#include "surface/diagnosis/superfluous_facets.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

using FacetGroups = std::vector<std::vector<std::int32_t>>;

Triangle in_ascending_order(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// The corner of a facet that is not on the edge of this one.
std::int32_t third_vertex(const std::vector<Triangle>& facets, std::int32_t corner) {
    return start_vertex(facets, next_corner(next_corner(corner)));
}

// Facets without copies, and a few others, are left out; those with a repeated vertex, too.
std::vector<std::int32_t> possible_copies(const std::vector<Triangle>& facets,
                                          const std::vector<std::int32_t>& partner) {
    constexpr std::size_t grain = std::size_t{1} << 16;
    const auto ranges = values_of_ranges(facets.size(), grain, [&](const IndexRange& range) {
        std::vector<std::int32_t> found;
        for (std::int32_t f = range.first, last = range.last; f < last; ++f) {
            bool is_possible = !has_repeated_vertex(facets[f]);
            for (std::int32_t c = 3 * f; is_possible && c < 3 * f + 3; ++c)
                is_possible = partner[c] < 0 || third_vertex(facets, c) == third_vertex(facets, partner[c]);
            if (is_possible) found.push_back(f);
        }
        return found;
    });
    std::vector<std::int32_t> all;
    for (const auto& found : ranges) all.insert(all.end(), found.begin(), found.end());
    return all;
}

// Groups of equal facets, in the order of their sorted vertices.
FacetGroups group_equal(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& possible) {
    std::vector<std::pair<Triangle, std::int32_t>> by_vertices;
    by_vertices.reserve(possible.size());
    for (const std::int32_t f : possible) by_vertices.emplace_back(in_ascending_order(facets[f]), f);
    std::sort(by_vertices.begin(), by_vertices.end());
    FacetGroups groups;
    for (std::size_t i = 1; i < by_vertices.size(); ++i) {
        if (by_vertices[i].first != by_vertices[i - 1].first) continue;
        if (groups.empty() || groups.back().back() != by_vertices[i - 1].second)
            groups.push_back({by_vertices[i - 1].second});
        groups.back().push_back(by_vertices[i].second);
    }
    return groups;
}

// One facet of each group, and all others that have no repeated vertex.
struct OneOfEach {
    std::vector<Triangle> facets;
    std::vector<std::int32_t> group;  // of each; -1: it has no copies
    std::vector<std::int32_t> place;  // of each group
};

OneOfEach one_of_each(const std::vector<Triangle>& facets, const FacetGroups& groups) {
    constexpr std::int32_t further = -2;
    std::vector<std::int32_t> group(facets.size(), -1);
    for (std::int32_t g = 0; g < count_of(groups); ++g) {
        for (const std::int32_t f : groups[g]) group[f] = further;
        group[groups[g].front()] = g;
    }
    OneOfEach single{{}, {}, std::vector<std::int32_t>(groups.size())};
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (group[f] == further || has_repeated_vertex(facets[f])) continue;
        if (group[f] >= 0) single.place[group[f]] = count_of(single.facets);
        single.facets.push_back(facets[f]);
        single.group.push_back(group[f]);
    }
    return single;
}

// Returns the number of facets at the three edges of each facet.
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
    return find_superfluous_facets(facets, edge_partners(facets));
}

SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets,
                                          const std::vector<std::int32_t>& partner) {
    SuperfluousFacets found;
    for (std::int32_t f = 0; f < count_of(facets); ++f)
        if (has_repeated_vertex(facets[f])) found.repeated_vertex.push_back(f);
    const FacetGroups groups = group_equal(facets, possible_copies(facets, partner));
    if (groups.empty()) return found;

    const OneOfEach single = one_of_each(facets, groups);
    const EdgeCorners edges(single.facets);
    const auto at_edges = facets_at_edges(edges, single.facets.size());
    const std::vector<std::int32_t> shell = shells_of(edges, single.facets.size());
    std::vector<char> only_copies(single.facets.size(), 1);
    for (std::size_t f = 0; f < single.facets.size(); ++f)
        if (single.group[f] < 0) only_copies[shell[f]] = 0;
    std::map<std::int32_t, std::int32_t> number;  // of the coincident shells; ordered, and there are few
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::int32_t place = single.place[g], own_shell = shell[place];
        FacetCopies& copies = found.copies.emplace_back();
        copies.facets = groups[g];
        copies.keep = number_to_keep(at_edges[place]);
        // A single facet with a copy is a flat pocket, not a body.
        if (!only_copies[own_shell] || copies.keep == 0) continue;
        const auto [it, is_new] = number.try_emplace(own_shell, count_of(number));
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
