// The best tetrahedra in place of those around an edge, without the edge.
#pragma once

#include "improve/edited_mesh.h"
#include "improve/polygon_triangulation.h"

namespace kerf {

/// For an edge from a to b inside of n cells, the triangulation of the polygon around it (its vertices in the order of
/// EdgeRing) whose cells, each triangle joined with a and with b, have the least largest badness (shewchuk2002). Only
/// what is better than `limit` counts.
class EdgeRemoval {
 public:
    /// Whether there is one. O(n^3).
    bool find(const EditedMesh& mesh, const EdgeRing& ring, double limit);
    /// The largest badness of its cells, and these.
    double badness() const { return polygon_.badness(); }
    const std::vector<Tetrahedron>& cells() const { return cells_; }

 private:
    PolygonTriangulation<EditedMesh::most_cells_of_a_ring> polygon_;
    std::vector<Tetrahedron> cells_;
};

}  // namespace kerf
