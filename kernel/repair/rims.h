// What hangs together over edges, and where it is open.
#pragma once

#include <utility>
#include <vector>

#include "surface/soup.h"

namespace kerf {

/// Facets that hang together over edges, of however many facets.
struct RimPiece {
    std::int64_t facets = 0, open_edges = 0, edges_of_many = 0;  ///< edges of one facet, and of more than two

    bool is_closed() const { return open_edges == 0; }
};

struct Rims {
    std::vector<char> is_open;           ///< 3 #F; whether the edge of a corner has no other facet
    std::vector<std::int32_t> piece_of;  ///< #F; numbered by smallest facet
    std::vector<RimPiece> pieces;

    std::vector<std::vector<std::int32_t>> facets_of_pieces() const;
};

/// Requires numbers >= 0 and no facet with a repeated vertex. Cost as EdgeCorners.
Rims find_rims(const std::vector<Triangle>& facets);

/// Facets with vertices of their own alone, which keep their order.
struct CompactFacets {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    std::vector<std::int32_t> vertex;  ///< the numbers that the vertices had
};

/// O(n log n) for n facets, however many vertices there are.
CompactFacets make_compact(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Whether all facets have three different vertices, with finite coordinates.
bool has_ordinary_facets(const Soup& soup);
bool is_ordinary(const std::vector<Vec3>& vertices, const Triangle& facet);

/// Whether these are bodies that share walls, and are regions as they are (surface/region_finder.h): edges of many
/// facets are no defect then; a hole in a wall is one, and does not count here. Requires ordinary facets.
bool is_of_touching_bodies(const Soup& soup);

/// The same facet seen from the other side.
inline void turn(Triangle& facet) { std::swap(facet[1], facet[2]); }

}  // namespace kerf
