// The two corners of an edge with two facets are partners if they are opposite to each other. Every other edge is a
// defect. A vertex is proven to have one fan by going around it over partners: if that does not meet all corners at the
// vertex, there is another fan.
#include "surface/complex/manifold_defects.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

ManifoldDefect edge_defect(ManifoldDefect::Kind kind, std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
    ManifoldDefect defect{kind, {low, corners[0].high}, {}};
    for (const EdgeCorners::Corner& c : corners) defect.facets.push_back(c.corner / 3);
    return defect;
}

enum class VertexCheck : char {
    none,
    fan,   // the facets around the vertex have to be one fan
    open,  // an edge without partner ends here, which is a defect of its own; see is_pinched()
};

constexpr std::size_t facets_of_pairing = std::size_t{1} << 16, vertices_of_pairing = std::size_t{1} << 16;

// Returns for each vertex that is to be checked the number of corners of one of its fans; 0 for others. `corners`
// becomes the number of corners at all such vertices.
std::vector<std::int32_t> sizes_of_fans(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner,
                                        const std::vector<VertexCheck>& check, std::size_t& corners) {
    std::vector<std::int32_t> size(check.size(), -1);  // first a corner, which one does not matter
    corners = 0;
    for (std::size_t f = 0; f < facets.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            if (check[facets[f][i]] != VertexCheck::fan) continue;
            size[facets[f][i]] = 3 * f + i;
            ++corners;
        }
    for_ranges_on_threads(check.size(), vertices_of_pairing, [&](const IndexRange& range) {
        for (std::size_t v = range.first; v < range.last; ++v) {
            const std::int32_t first = std::exchange(size[v], 0);
            if (first < 0) continue;
            std::int32_t corner = first;
            do {
                ++size[v];
                corner = next_corner(partner[corner]);
            } while (corner != first);
        }
    });
    return size;
}

// Facets around a vertex that are joined over proper edges form one fan at a manifold vertex.
void find_vertex_defects(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner,
                         const std::vector<VertexCheck>& check, std::vector<ManifoldDefect>& defects) {
    // The corners of a vertex that remain when those of one fan are taken away.
    std::size_t corners = 0;
    std::vector<std::int32_t> rest = sizes_of_fans(facets, partner, check, corners);
    if (std::accumulate(rest.begin(), rest.end(), std::size_t{0}) == corners) return;
    for (std::int32_t& size : rest) size = -size;
    for (const Triangle& t : facets)
        for (const std::int32_t v : t) rest[v] += check[v] == VertexCheck::fan;
    std::vector<std::int32_t> slot(check.size(), -1);
    const std::size_t first_new = defects.size();
    for (std::int32_t v = 0; v < count_of(check); ++v)
        if (rest[v] != 0) {
            slot[v] = count_of(defects);
            defects.push_back({ManifoldDefect::Kind::non_manifold_vertex, {v}, {}});
        }
    if (defects.size() == first_new) return;
    for (std::int32_t f = 0; f < count_of(facets); ++f)
        for (std::int32_t v : facets[f])
            if (slot[v] >= 0) defects[slot[v]].facets.push_back(f);
}

// True if one of the fans at a vertex has neither gap nor defect towards the others: whatever closes or parts those,
// the surface is pinched here. Fans with a gap may be parts of one fan with several gaps. `around`: the vertex's
// facets.
bool is_pinched(const std::vector<Triangle>& facets, std::int32_t vertex, std::span<const std::int32_t> around) {
    std::vector<std::pair<std::int32_t, std::int32_t>> spokes;  // far end, place in `around`
    for (std::int32_t i = 0; i < count_of(around); ++i)
        for (std::int32_t v : facets[around[i]])
            if (v != vertex) spokes.emplace_back(v, i);
    std::sort(spokes.begin(), spokes.end());
    UnionFind fans(around.size());
    std::vector<std::int32_t> at_gap;
    for (std::size_t i = 0, j = 0; i < spokes.size(); i = j) {
        while (j < spokes.size() && spokes[j].first == spokes[i].first) fans.join(spokes[j++].second, spokes[i].second);
        if (j == i + 1) at_gap.push_back(spokes[i].second);
    }
    std::vector<char> has_gap(around.size(), 0);
    for (const std::int32_t i : at_gap) has_gap[fans.root(i)] = 1;
    std::size_t whole = 0;
    for (std::int32_t i = 0; i < count_of(around); ++i) whole += fans.root(i) == i && !has_gap[i];
    return whole + (at_gap.empty() ? 0 : 1) > 1;
}

void find_pinched_vertices(const std::vector<Triangle>& facets, const std::vector<VertexCheck>& check,
                           std::vector<ManifoldDefect>& defects) {
    std::vector<std::pair<std::int32_t, std::int32_t>> at;  // vertex, facet
    for (std::int32_t f = 0; f < count_of(facets); ++f)
        for (std::int32_t v : facets[f])
            if (check[v] == VertexCheck::open) at.emplace_back(v, f);
    std::sort(at.begin(), at.end());
    for (std::size_t i = 0, j = 0; i < at.size(); i = j) {
        std::vector<std::int32_t> around;
        for (; j < at.size() && at[j].first == at[i].first; ++j) around.push_back(at[j].second);
        if (is_pinched(facets, at[i].first, around))
            defects.push_back({ManifoldDefect::Kind::non_manifold_vertex, {at[i].first}, std::move(around)});
    }
}

// Pairs the corners without partners where that can be done, and looks for defects there and at vertices to be checked.
CornerPairing pair_corners(const std::vector<Triangle>& facets, std::vector<std::int32_t> partner,
                           std::vector<VertexCheck> check) {
    CornerPairing pairing{std::move(partner), {}};
    const auto note_defect = [&](ManifoldDefect::Kind kind, std::int32_t low,
                                 std::span<const EdgeCorners::Corner> corners) {
        pairing.defects.push_back(edge_defect(kind, low, corners));
        check[low] = check[corners[0].high] = VertexCheck::open;
    };
    const auto pair = [&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        using Kind = ManifoldDefect::Kind;
        if (corners.size() != 2) {
            note_defect(corners.size() == 1 ? Kind::open_edge : Kind::non_manifold_edge, low, corners);
        } else if (start_vertex(facets, corners[0].corner) == start_vertex(facets, corners[1].corner)) {
            note_defect(Kind::edge_orientation, low, corners);
        } else {
            pairing.partner[corners[0].corner] = corners[1].corner;
            pairing.partner[corners[1].corner] = corners[0].corner;
        }
    };
    if (std::find(pairing.partner.begin(), pairing.partner.end(), -1) != pairing.partner.end())
        EdgeCorners(facets, pairing.partner).for_each_edge(pair);
    find_vertex_defects(facets, pairing.partner, check, pairing.defects);
    if (!pairing.defects.empty()) find_pinched_vertices(facets, check, pairing.defects);
    return pairing;
}

}  // namespace

CornerPairing pair_open_corners(std::size_t vertex_count, const std::vector<Triangle>& facets,
                                std::vector<std::int32_t> partner) {
    std::vector<VertexCheck> check(vertex_count, VertexCheck::none);
    for (std::size_t c = 0; c < partner.size(); ++c)
        if (partner[c] < 0) check[facets[c / 3][c % 3]] = check[facets[c / 3][(c + 1) % 3]] = VertexCheck::fan;
    return pair_corners(facets, std::move(partner), std::move(check));
}

CornerPairing pair_all_corners(std::size_t vertex_count, const std::vector<Triangle>& facets,
                               std::vector<std::int32_t> partner) {
    for_ranges_on_threads(facets.size(), facets_of_pairing, [&](const IndexRange& range) {
        for (std::size_t c = 3 * range.first; c < 3 * range.last; ++c)
            if (partner[c] >= 0 && start_vertex(facets, c) == start_vertex(facets, partner[c])) partner[c] = -1;
    });
    return pair_corners(facets, std::move(partner), std::vector<VertexCheck>(vertex_count, VertexCheck::fan));
}

std::vector<ManifoldDefect> find_manifold_defects(std::size_t vertex_count, const std::vector<Triangle>& facets,
                                                  std::vector<std::int32_t> partner) {
    KERF_CHECK(are_in_range(facets, vertex_count) && have_distinct_corners(facets));
    std::vector<ManifoldDefect> defects = pair_all_corners(vertex_count, facets, std::move(partner)).defects;
    std::stable_sort(defects.begin(), defects.end(),
                     [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
    return defects;
}

std::vector<ManifoldDefect> find_manifold_defects(std::size_t vertex_count, const std::vector<Triangle>& facets) {
    KERF_CHECK(are_in_range(facets, vertex_count));
    return find_manifold_defects(vertex_count, facets, edge_partners(facets));
}

}  // namespace kerf
