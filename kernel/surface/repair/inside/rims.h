// Pieces of a surface that hang together over edges, and their open edges.
#pragma once

#include <utility>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// Facets that hang together over edges, of however many facets.
struct RimPiece {
    std::int64_t facets = 0, open_edges = 0, edges_of_many = 0;  ///< open: of one facet; of many: of more than two

    bool is_closed() const { return open_edges == 0; }
};

/// The pieces of a surface and its open edges.
struct Rims {
    std::vector<char> is_open;           ///< 3 #F; the edge of a corner has no other facet
    std::vector<std::int32_t> piece_of;  ///< #F; numbered by smallest facet
    std::vector<RimPiece> pieces;

    std::vector<std::vector<std::int32_t>> facets_of_pieces() const;
};

/// Finds pieces and open edges. Requires numbers >= 0 and no facet with a repeated vertex. Cost as EdgeCorners.
Rims find_rims(const std::vector<Triangle>& facets);

/// Facets that keep their order, with vertices of their own alone.
struct CompactFacets {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    std::vector<std::int32_t> vertex;  ///< the former numbers of the vertices
};

/// Makes facets compact in O(n log n) for n facets, however many vertices there are.
CompactFacets make_compact(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Whether all facets have three different vertices, with finite coordinates.
bool has_ordinary_facets(const Soup& soup);
bool is_ordinary(const std::vector<Vec3>& vertices, const Triangle& facet);

/// Whether the facets are those of bodies that share walls, which are regions as they are
/// (surface/regions/region_finder.h): edges of many facets are no defect then; a hole in a wall is one, but does not
/// count here. Requires ordinary facets.
bool is_of_touching_bodies(const Soup& soup);

/// Turns a facet over.
inline void turn(Triangle& facet) { std::swap(facet[1], facet[2]); }

}  // namespace kerf
