// The tetrahedra of one subdomain as flat arrays.
#pragma once

#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

/// The place of a tetrahedron among those of a mesh, or of EditableTets (fill/mesh/editable_tets.h).
using CellId = Id<struct CellTag>;

/// The neighbours of each tetrahedron: number i is the tetrahedron across the face opposite to corner i, or none.
using TetNeighbours = Array<CellId, std::array<CellId, 4>>;

/// A mesh of one subdomain. The boundary vertices and facets of the subdomain keep their numbers in it; interior
/// vertices follow.
struct TetMesh {
    std::vector<Vec3> vertices;              ///< #V; the vertices of the surface first, bit for bit and in order
    std::int32_t boundary_vertex_count = 0;  ///< number of the vertices of the surface
    Array<CellId, Tetrahedron> tets;         ///< #T; positively oriented
    TetNeighbours neighbours;                ///< #T, or none: they follow from `tets` (fill/mesh/adjacency.h)

    std::int32_t interior_vertex_count() const { return count_of(vertices) - boundary_vertex_count; }
};

/// Corners of the face opposite to corner i, counter-clockwise seen from outside of the tetrahedron.
inline constexpr std::array<std::array<int, 3>, 4> tet_faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace kerf
