// Copies are found by sorting facets by their sorted vertices. With one of each, every edge should have two facets; an
// edge that has three then has one without them. Shells of nothing but copies are found by union-find over the edges.
#include "surface/superfluous_facets.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "core/elements.h"

namespace kerf {

namespace {

using Edge = std::array<std::int32_t, 2>;

Edge edge_of(const Triangle& t, std::size_t i) {
    const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
    return {low, high};
}

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

struct Side {
    Edge edge;
    std::int32_t group;
    friend auto operator<=>(const Side&, const Side&) = default;
};

// The groups at every edge, sorted by edge.
std::vector<Side> sides_of(const std::vector<Triangle>& facets, const std::vector<std::vector<std::int32_t>>& groups) {
    std::vector<Side> sides;
    sides.reserve(3 * groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t i = 0; i < 3; ++i)
            sides.push_back({edge_of(facets[groups[g].front()], i), static_cast<std::int32_t>(g)});
    std::sort(sides.begin(), sides.end());
    return sides;
}

std::int64_t groups_at(const std::vector<Side>& sides, const Edge& edge) {
    return std::upper_bound(sides.begin(), sides.end(), Side{edge, INT32_MAX}) -
           std::lower_bound(sides.begin(), sides.end(), Side{edge, 0});
}

std::int32_t number_to_keep(const Triangle& facet, const std::vector<Side>& sides) {
    std::array<std::int64_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = groups_at(sides, edge_of(facet, i));
    const auto all = [&](auto good) { return std::all_of(at.begin(), at.end(), good); };
    if (all([](std::int64_t n) { return n == 2; })) return 1;
    return all([](std::int64_t n) { return n == 1 || n == 3; }) ? 0 : -1;
}

// The shell of every group: a representative group.
std::vector<std::int32_t> shells_of(const std::vector<Side>& sides, std::size_t group_count) {
    std::vector<std::int32_t> parent(group_count);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t g) {
        while (parent[g] != g) g = parent[g] = parent[parent[g]];
        return g;
    };
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].edge != sides[i - 1].edge) continue;
        const auto [low, high] = std::minmax({root(sides[i].group), root(sides[i - 1].group)});
        parent[high] = low;
    }
    for (std::size_t g = 0; g < group_count; ++g) parent[g] = root(static_cast<std::int32_t>(g));
    return parent;
}

}  // namespace

SuperfluousFacets find_superfluous_facets(const std::vector<Triangle>& facets) {
    SuperfluousFacets found;
    for (std::size_t f = 0; f < facets.size(); ++f)
        if (has_repeated_vertex(facets[f])) found.repeated_vertex.push_back(static_cast<std::int32_t>(f));
    const auto groups = group_equal(facets);
    if (groups.size() + found.repeated_vertex.size() == facets.size()) return found;

    const std::vector<Side> sides = sides_of(facets, groups);
    const std::vector<std::int32_t> shell = shells_of(sides, groups.size());
    std::vector<char> only_copies(groups.size(), 1);
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].size() == 1) only_copies[shell[g]] = 0;
    std::map<std::int32_t, std::int32_t> number;  // of the coincident shells; ordered, and there are few
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].size() == 1) continue;
        FacetCopies& copies = found.copies.emplace_back();
        copies.facets = groups[g];
        copies.keep = number_to_keep(facets[groups[g].front()], sides);
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
