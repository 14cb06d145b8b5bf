// The best tetrahedra in place of those around an edge, without the edge.
#pragma once

#include <optional>

#include "improve/edited_mesh.h"

namespace kerf {

/// For an edge from a to b inside of n cells, the triangulation of the polygon around it (its vertices in the order of
/// EdgeRing) whose cells, each triangle joined with a and with b, have the least largest badness: by dynamic
/// programming over its diagonals (klincsek1980; shewchuk2002 for cells). Only what is better than `limit` counts.
class EdgeRemoval {
 public:
    /// Whether there is one. O(n^3).
    bool find(const EditedMesh& mesh, const EdgeRing& ring, double limit);
    /// The largest badness of its cells, and these.
    double badness() const { return badness_; }
    const std::vector<Tetrahedron>& cells() const { return cells_; }

 private:
    static constexpr std::size_t most = EditedMesh::most_cells_of_a_ring;

    double badness_of_triangle(const EditedMesh& mesh, const EdgeRing& ring, std::size_t i, std::size_t j,
                               std::size_t k, double limit, double excess) const;
    void add_cells(const EdgeRing& ring, std::size_t from, std::size_t to);

    double badness_ = 0;
    std::vector<Tetrahedron> cells_;
    std::array<Vec3, most> points_;
    // Of the part of the polygon from one vertex to another: the least badness, and the vertex of its last triangle.
    std::array<std::array<double, most>, most> best_;
    std::array<std::array<std::uint8_t, most>, most> middle_;
};

}  // namespace kerf
