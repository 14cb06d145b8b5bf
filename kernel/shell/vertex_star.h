// The cells around a vertex that may move, or go.
#pragma once

#include <functional>
#include <vector>

#include "mesh/editable_tets.h"

namespace kerf {

/// The star of a vertex that is not on the boundary, until the next change. How bad cells are, see
/// improve/cell_shape.h; infinity where one is not positive.
class VertexStar {
 public:
    VertexStar(EditableTets& tets, std::int32_t vertex);

    const Vec3& at() const { return point(vertex_); }
    /// Ascending.
    const std::vector<std::int32_t>& neighbours() const { return neighbours_; }
    double shortest_edge_sq() const;

    /// The badness of the worst cell if the vertex were there.
    double badness_at(const Vec3& p) const;
    void move_to(const Vec3& p) { tets_.move_vertex(vertex_, p); }

    /// Cells in place of the star, without the vertex.
    struct Merged {
        double badness;  ///< of the worst
        std::vector<Tetrahedron> cells;
    };
    /// The best of the cells when the vertex is moved to a neighbour, of those that are all accepted. No cells if none
    /// is below the limit.
    Merged best_merged(double limit, const std::function<bool(const std::array<Vec3, 4>&)>& accepts = {}) const;
    void replace_by(const Merged& merged) { tets_.replace(cells_, merged.cells); }

 private:
    const Vec3& point(std::int32_t vertex) const { return tets_.points()[vertex]; }
    double badness_of(const std::array<Vec3, 4>& corners) const;

    EditableTets& tets_;
    std::int32_t vertex_;
    std::vector<std::int32_t> cells_, neighbours_;
};

}  // namespace kerf
