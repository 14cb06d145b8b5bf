// Better cells around a new vertex in place of a bad one and some around it.
#pragma once

#include <optional>

#include "improve/best_place.h"

namespace kerf {

/// A cavity begins as the cells around an edge of the bad one, the vertex in the middle of that, or, for a sliver with
/// facets where that does not do, below them. Then it grows, across the worst of its faces as seen from the vertex to
/// what is better, in turn with moves of the vertex to its best place (klingner2007 grow theirs by a measure of what is
/// gained). Every corner of the cavity stays on its boundary.
class VertexInsertion {
 public:
    /// `depths`: how far below the facets of the cell the vertex may begin, too, in lengths of an edge and in this
    /// order until one does, as where those around it are as flat as it is. Returns the cells that the new ones
    /// replace; none if there is no vertex whose worst cell is better than `limit`, and nothing has changed. The vertex
    /// has been added, and cells() are those around it.
    std::span<const std::int32_t> insert(EditedMesh& mesh, std::int32_t cell, double limit,
                                         std::span<const double> depths);
    const std::vector<Tetrahedron>& cells() const { return cells_; }

 private:
    struct Side {
        std::int32_t cell;
        int i;
        double badness;  // of the cell between it and the place
    };

    static Vec3 away_from_boundary(const EditedMesh& mesh, std::int32_t cell);
    void try_all_edges(const EditedMesh& mesh, std::int32_t cell, const Vec3& away);
    void grow_and_move(const EditedMesh& mesh, const Vec3& start);
    void find_sides(const EditedMesh& mesh);
    bool grow(const EditedMesh& mesh, const Vec3& at);
    bool has_inner_vertex(const EditedMesh& mesh) const;
    bool contains(std::int32_t cell) const;
    double badness_at(const EditedMesh& mesh, const Vec3& at, std::int32_t cell, int i) const;
    double worst_at(const EditedMesh& mesh, const Vec3& at) const;

    EdgeRing ring_;
    std::vector<std::int32_t> cavity_, best_cavity_;
    BestPlace::Place best_ = {};
    std::vector<Side> sides_;
    double excess_ = 1;
    BestPlace places_;
    std::vector<Tetrahedron> cells_;
};

}  // namespace kerf
