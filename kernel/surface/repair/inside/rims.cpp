#include "surface/repair/inside/rims.h"

#include <algorithm>
#include <span>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/union_find.h"
#include "surface/regions/region_finder.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

std::vector<std::vector<std::int32_t>> Rims::facets_of_pieces() const {
    std::vector<std::vector<std::int32_t>> facets(pieces.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) facets[p].reserve(pieces[p].facets);
    for (std::int32_t f = 0; f < count_of(piece_of); ++f) facets[piece_of[f]].push_back(f);
    return facets;
}

Rims find_rims(const std::vector<Triangle>& facets) {
    Rims rims{std::vector<char>(3 * facets.size(), 0), {}, {}};
    const EdgeCorners edges(facets);
    UnionFind sets(facets.size());
    edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        for (const EdgeCorners::Corner& c : corners) sets.join(corners[0].corner / 3, c.corner / 3);
        if (corners.size() == 1) rims.is_open[corners[0].corner] = 1;
    });
    Components components = sets.take();
    rims.piece_of = std::move(components.of);
    rims.pieces.resize(components.count);
    for (const std::int32_t piece : rims.piece_of) ++rims.pieces[piece].facets;
    edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        RimPiece& piece = rims.pieces[rims.piece_of[corners[0].corner / 3]];
        piece.open_edges += corners.size() == 1;
        piece.edges_of_many += corners.size() > 2;
    });
    return rims;
}

bool is_ordinary(const std::vector<Vec3>& vertices, const Triangle& facet) {
    return !has_repeated_vertex(facet) &&
           std::all_of(facet.begin(), facet.end(), [&](std::int32_t v) { return vertices[v].allFinite(); });
}

bool has_ordinary_facets(const Soup& soup) {
    return std::all_of(soup.facets.begin(), soup.facets.end(),
                       [&](const Triangle& t) { return is_ordinary(soup.vertices, t); });
}

bool is_of_touching_bodies(const Soup& soup) {
    if (!has_edge_of_many(soup.facets)) return false;
    Soup found = soup;
    found.may_end_inside = true;  // a wall with a hole is one none the less, and is not to be taken out for it
    return find_touching_bodies(found);
}

CompactFacets make_compact(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    CompactFacets compact;
    for (const Triangle& t : facets) compact.vertex.insert(compact.vertex.end(), t.begin(), t.end());
    std::sort(compact.vertex.begin(), compact.vertex.end());
    compact.vertex.erase(std::unique(compact.vertex.begin(), compact.vertex.end()), compact.vertex.end());
    for (const std::int32_t v : compact.vertex) compact.vertices.push_back(vertices[v]);
    compact.facets = facets;
    for (Triangle& t : compact.facets)
        for (std::int32_t& v : t)
            v = std::lower_bound(compact.vertex.begin(), compact.vertex.end(), v) - compact.vertex.begin();
    return compact;
}

}  // namespace kerf
