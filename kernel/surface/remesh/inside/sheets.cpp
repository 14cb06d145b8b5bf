#include "surface/remesh/inside/sheets.h"

#include <numeric>

#include "base/core/ids.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// A fan is a set of corners at one vertex.
UnionFind find_fans(const std::vector<std::int32_t>& partner) {
    UnionFind fans(partner.size());
    for (std::int32_t corner = 0; corner < count_of(partner); ++corner) {
        if (partner[corner] > corner) {
            fans.join(corner, next_corner(partner[corner]));
            fans.join(next_corner(corner), partner[corner]);
        }
    }
    return fans;
}

}  // namespace

UndirectedEdge Sheets::edge_before(std::int32_t corner) const {
    return undirected(original[start_vertex(surface.facets, corner)],
                      original[start_vertex(surface.facets, next_corner(corner))]);
}

std::vector<Triangle> Sheets::facets_before() const {
    std::vector<Triangle> facets = surface.facets;
    for (Triangle& t : facets)
        for (std::int32_t& v : t) v = original[v];
    return facets;
}

std::vector<std::int32_t> separate_fans(std::size_t vertices, const std::vector<std::int32_t>& partner,
                                        std::vector<Triangle>& facets) {
    std::vector<std::int32_t> original(vertices), vertex_of(partner.size());  // of a fan, by its smallest corner
    std::iota(original.begin(), original.end(), 0);
    UnionFind fans = find_fans(partner);
    std::vector<char> has_fan(vertices, 0);
    for (std::int32_t corner = 0; corner < count_of(vertex_of); ++corner) {
        std::int32_t& v = facets[corner / 3][corner % 3];
        const std::int32_t first = fans.root(corner);
        if (first == corner) {
            vertex_of[corner] = v;
            if (has_fan[v] != 0) {
                vertex_of[corner] = count_of(original);
                original.push_back(v);
            }
            has_fan[v] = 1;
        }
        v = vertex_of[first];
    }
    return original;
}

Sheets take_apart(const SurfaceArrays& surface) {
    Sheets sheets = {surface, edge_partners(surface.facets), {}, surface.vertices.size()};
    sheets.original = separate_fans(surface.vertices.size(), sheets.partner, sheets.surface.facets);
    for (std::size_t v = surface.vertices.size(); v < sheets.original.size(); ++v) {
        sheets.surface.vertices.push_back(surface.vertices[sheets.original[v]]);
        sheets.surface.vertex_key.push_back(surface.vertex_key[sheets.original[v]]);
    }
    return sheets;
}

}  // namespace kerf
