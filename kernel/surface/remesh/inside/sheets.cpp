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

Sheets take_apart(const SurfaceArrays& surface) {
    Sheets sheets = {surface, edge_partners(surface.facets), std::vector<std::int32_t>(surface.vertices.size()),
                     surface.vertices.size()};
    std::iota(sheets.original.begin(), sheets.original.end(), 0);
    UnionFind fans = find_fans(sheets.partner);
    std::vector<char> has_fan(surface.vertices.size(), 0);
    std::vector<std::int32_t> vertex_of(sheets.partner.size());  // of a fan, by its smallest corner
    for (std::int32_t corner = 0; corner < count_of(vertex_of); ++corner) {
        const std::int32_t first = fans.root(corner), v = start_vertex(surface.facets, corner);
        if (first == corner) {
            vertex_of[corner] = v;
            if (has_fan[v] != 0) {
                vertex_of[corner] = count_of(sheets.original);
                sheets.surface.vertices.push_back(surface.vertices[v]);
                sheets.surface.vertex_key.push_back(surface.vertex_key[v]);
                sheets.original.push_back(v);
            }
            has_fan[v] = 1;
        }
        sheets.surface.facets[corner / 3][corner % 3] = vertex_of[first];
    }
    return sheets;
}

}  // namespace kerf
