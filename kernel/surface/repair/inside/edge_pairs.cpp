#include "surface/repair/inside/edge_pairs.h"

#include <algorithm>
#include <span>

#include "base/core/ids.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/radial_order.h"

namespace kerf {

namespace {

// Sorts the corners so that those at 0 and 1, 2 and 3, ... have material between them: going around the edge, every
// pair that begins within another ends within it, as brackets do.
void pair_crowded(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                  std::span<const EdgeCorners::Corner> corners, CrowdedEdge& edge) {
    for (const EdgeCorners::Corner& c : corners) edge.corners.push_back(c.corner);
    const RadialOrder around = radial_order(vertices, facets, edge.low, corners);
    if (around.defect != RadialDefect::none) {
        edge.reason =
            around.defect == RadialDefect::no_area ? "a facet there has no area" : "facets there lie upon each other";
        return;
    }
    const std::vector<std::int32_t>& order = around.corners;
    edge.corners.clear();
    std::vector<std::int32_t> open;
    for (std::size_t i = 0; i < 2 * order.size(); ++i) {  // twice around: a pair may end before it has begun
        const std::int32_t corner = order[i % order.size()];
        if (has_back_ahead(facets, edge.low, corner)) {
            if (i < order.size()) open.push_back(corner);
        } else if (!open.empty() && std::find(edge.corners.begin(), edge.corners.end(), corner) == edge.corners.end()) {
            edge.corners.insert(edge.corners.end(), {open.back(), corner});
            open.pop_back();
        }
    }
    edge.is_paired = edge.corners.size() == order.size();
    if (edge.is_paired) return;
    edge.corners = order;
    edge.reason = "the facets there are walls, or sheets that bound nothing";
}

// Joins the corners of two facets at both ends of their common edge.
void join_ends(const std::vector<Triangle>& facets, std::int32_t c, std::int32_t d, UnionFind& fans) {
    const bool same_way = start_vertex(facets, c) == start_vertex(facets, d);
    fans.join(c, same_way ? d : next_corner(d));
    fans.join(next_corner(c), same_way ? next_corner(d) : d);
}

}  // namespace

EdgePairs pair_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    EdgePairs pairs{std::vector<std::int32_t>(3 * facets.size(), -1), std::vector<char>(3 * facets.size(), 0), {}};
    const auto join = [&](std::int32_t c, std::int32_t d) {
        pairs.partner[c] = d;
        pairs.partner[d] = c;
    };
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() == 1) {
            pairs.is_open[corners[0].corner] = 1;
        } else if (corners.size() == 2) {
            join(corners[0].corner, corners[1].corner);
        } else {
            CrowdedEdge& edge = pairs.crowded.emplace_back(CrowdedEdge{low, corners[0].high, {}});
            pair_crowded(vertices, facets, corners, edge);
            for (std::size_t i = 0; edge.is_paired && i < edge.corners.size(); i += 2)
                join(edge.corners[i], edge.corners[i + 1]);
        }
    });
    return pairs;
}

std::vector<std::int32_t> find_fans(const std::vector<Triangle>& facets, const EdgePairs& pairs) {
    UnionFind fans(3 * facets.size());
    for (std::int32_t c = 0; c < count_of(pairs.partner); ++c)
        if (pairs.partner[c] > c) join_ends(facets, c, pairs.partner[c], fans);
    for (const CrowdedEdge& edge : pairs.crowded)
        for (std::size_t i = 1; !edge.is_paired && i < edge.corners.size(); ++i)
            join_ends(facets, edge.corners[0], edge.corners[i], fans);
    std::vector<std::int32_t> root(3 * facets.size());
    for (std::int32_t c = 0; c < count_of(root); ++c) root[c] = fans.root(c);
    return root;
}

}  // namespace kerf
