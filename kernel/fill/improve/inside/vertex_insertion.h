// Better cells around a new vertex, in the place of a bad cell and some around it.
#pragma once

#include <optional>

#include "fill/improve/inside/best_place.h"

namespace kerf {

/// Replaces a cavity by cells around a new vertex. The cavity begins as the cells around an edge of the bad cell, and
/// the vertex in the middle of that edge, or, for a sliver with facets where that does not do, below them. Then the
/// cavity grows, across the worst of its faces as seen from the vertex to cells that are better, in turn with moves of
/// the vertex to its best place (Klingner and Shewchuk 2007, klingner2007, let it grow by a measure of the gain). Every
/// corner of the cavity stays on its boundary.
class VertexInsertion {
 public:
    /// Finds the vertex and adds it to the mesh. Returns the cells that the new ones replace, and cells() are the new
    /// ones; none, and nothing has changed, if there is no vertex whose worst cell is better than `limit`. `depths`:
    /// depths below the facets of the cell at which the vertex may begin, too, in lengths of an edge, tried in this
    /// order until one succeeds; needed where the cells around are as flat as the cell is.
    std::span<const CellId> insert(ImprovedMesh& mesh, CellId cell, double limit, std::span<const double> depths);
    const std::vector<Tetrahedron>& cells() const { return cells_; }

 private:
    struct Side {
        CellId cell;
        int i;
        double badness;  // badness of the cell between the side and the place
    };

    static Vec3 away_from_boundary(const ImprovedMesh& mesh, CellId cell);
    void try_all_edges(const ImprovedMesh& mesh, CellId cell, const Vec3& away);
    void grow_and_move(const ImprovedMesh& mesh, const Vec3& start);
    void find_sides(const ImprovedMesh& mesh);
    bool grow(const ImprovedMesh& mesh, const Vec3& at);
    bool has_inner_vertex(const ImprovedMesh& mesh) const;
    bool contains(CellId cell) const;
    double badness_at(const ImprovedMesh& mesh, const Vec3& at, CellId cell, int i) const;
    double worst_at(const ImprovedMesh& mesh, const Vec3& at) const;

    EdgeRing ring_;
    std::vector<CellId> cavity_, best_cavity_;
    BestPlace::Place best_ = {};
    std::vector<Side> sides_;
    double excess_ = 1;
    BestPlace places_;
    std::vector<Tetrahedron> cells_;
};

}  // namespace kerf
