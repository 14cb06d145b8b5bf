#include "fill/mesh/adjacency.h"

#include "base/core/check.h"
#include "base/core/elements.h"
#include "fill/mesh/faces.h"

namespace kerf {

TetNeighbours find_neighbours(const TetMesh& mesh) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    TetNeighbours neighbours(mesh.tets.size(), {CellId::none(), CellId::none(), CellId::none(), CellId::none()});
    const auto join = [&](FaceSide a, FaceSide b) {
        neighbours[a.tet()][a.corner()] = b.tet();
        neighbours[b.tet()][b.corner()] = a.tet();
    };
    match_faces(mesh, join, [](FaceSide) {});
    return neighbours;
}

}  // namespace kerf
