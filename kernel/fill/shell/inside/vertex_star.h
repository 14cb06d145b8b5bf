// The cells around a vertex that may move, or go.
#pragma once

#include <functional>
#include <vector>

#include "fill/mesh/editable_tets.h"

namespace kerf {

/// The star of a vertex that is not on the boundary, valid until the next change. Badness is that of
/// fill/improve/cell_shape.h; infinity where a cell is not positive.
class VertexStar {
 public:
    VertexStar(EditableTets& tets, std::int32_t vertex);

    const Vec3& at() const { return point(vertex_); }
    /// Returns the vertices that share a cell with it, ascending.
    const std::vector<std::int32_t>& neighbours() const { return neighbours_; }
    double shortest_edge_sq() const;

    /// Returns the badness of the worst cell if the vertex were at p.
    double badness_at(const Vec3& p) const;
    void move_to(const Vec3& p) { tets_.move_vertex(vertex_, p); }

    /// Cells in place of the star, without the vertex.
    struct Merged {
        double badness;  ///< badness of the worst cell
        std::vector<Tetrahedron> cells;
    };
    /// Returns the best cells that come of moving the vertex to a neighbour, of those that are all accepted. No cells
    /// if none are below the limit.
    Merged best_merged(double limit, const std::function<bool(const std::array<Vec3, 4>&)>& accepts = {}) const;
    void replace_by(const Merged& merged) { tets_.replace(cells_, merged.cells); }

 private:
    const Vec3& point(std::int32_t vertex) const { return tets_.points()[vertex]; }
    double badness_of(const std::array<Vec3, 4>& corners) const;

    EditableTets& tets_;
    std::int32_t vertex_;
    std::vector<CellId> cells_;
    std::vector<std::int32_t> neighbours_;
};

}  // namespace kerf
