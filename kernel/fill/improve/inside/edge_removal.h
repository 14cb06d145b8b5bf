// The best tetrahedra in the place of those around an edge, without the edge.
#pragma once

#include "fill/improve/inside/improved_mesh.h"
#include "fill/improve/polygon_triangulation.h"

namespace kerf {

/// Finds, for an edge from a to b inside of n cells, the triangulation of the polygon around it (its vertices in the
/// order of EdgeRing) whose cells, each triangle joined with a and with b, have the least largest badness (Shewchuk
/// 2002, shewchuk2002). Only cells that are better than `limit` count.
class EdgeRemoval {
 public:
    /// Finds the cells; false if there are none. O(n^3).
    bool find(const ImprovedMesh& mesh, const EdgeRing& ring, double limit);
    /// The largest badness of the cells that were found, and these.
    double badness() const { return polygon_.badness(); }
    const std::vector<Tetrahedron>& cells() const { return cells_; }

 private:
    PolygonTriangulation<ImprovedMesh::most_cells_of_a_ring> polygon_;
    std::vector<Tetrahedron> cells_;
};

}  // namespace kerf
