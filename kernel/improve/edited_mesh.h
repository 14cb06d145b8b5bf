// A mesh that is made better: its cells, what they are like, and what they may become.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "improve/cell_shape.h"
#include "mesh/editable_tets.h"
#include "size/size_field.h"

namespace kerf {

/// The cells of a mesh, how bad they are, and what new cells must be, see badness_of() and is_positive(). Numbers of
/// cells do not change until finish(). 40 bytes a cell and 29 a vertex.
class EditedMesh {
 public:
    static constexpr std::int32_t most_cells = EditableTets::most_cells;
    static constexpr std::size_t most_cells_of_a_ring = 10;

    /// Finds neighbours where the mesh has none, and looks at the shapes of all cells, which `visit` is told. The first
    /// `frozen_cells` cells never change. Error (memory) if there are more than `most`, which is at most most_cells.
    EditedMesh(TetMesh mesh, std::int64_t frozen_cells, SizeField max_size,
               const std::function<void(const CellShape&)>& visit, std::int32_t most = most_cells);
    /// The mesh as it is now, without gaps among the cells, and with neighbours if it had some. Afterwards there are no
    /// cells.
    TetMesh finish();

    // --- what there is ---

    std::int32_t cell_count() const { return tets_.cell_count(); }
    bool is_removed(std::int32_t cell) const { return corners(cell)[0] < 0; }
    bool is_frozen(std::int32_t cell) const { return cell < frozen_cells_; }
    const Tetrahedron& corners(std::int32_t cell) const { return tets_.vertices(cell); }
    const Vec3& point(std::int32_t vertex) const { return tets_.points()[vertex]; }
    double badness(std::int32_t cell) const { return badness_[cell]; }
    /// Behind the face opposite to corner i; below 0: the boundary.
    std::int32_t neighbour(std::int32_t cell, int i) const { return tets_.neighbour(cell, i); }
    /// Opposite to corner i, and positive after it.
    Triangle face(std::int32_t cell, int i) const { return tets_.face_vertices(cell_face(cell, i)); }
    CellShape shape(const Tetrahedron& corners) const {
        return cell_shape(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3]));
    }
    /// Those around the edge between corners i and j of a cell. False if it lies on the boundary, has a frozen cell, or
    /// more cells than most_cells_of_a_ring.
    bool find_ring(std::int32_t cell, int i, int j, EdgeRing& ring) const;
    /// Finds the cells around the corner i of a cell. False if the corner must not move.
    bool find_star(std::int32_t cell, int i, std::vector<std::int32_t>& star);

    // --- what may be ---

    /// The largest volume over its bound of these cells, at least 1: what new ones in their place may have.
    double most_excess(std::span<const std::int32_t> cells) const;
    /// The badness of a new cell with these corners; infinity if it has an angle beyond all that there were, or exceeds
    /// its bound of volume more.
    double badness_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double excess) const;
    /// How often badness_of() was asked: what it has cost so far, without a clock.
    std::int64_t evaluations() const { return evaluations_; }
    bool is_positive(const Tetrahedron& corners) const;

    // --- changes ---

    /// Replaces cells by others, positive ones, that fill the same space and have the same faces around them. The
    /// numbers of the new ones are valid until the next change. Error (memory), and nothing has changed, if there would
    /// be too many.
    std::span<const std::int32_t> replace(std::span<const std::int32_t> cells, std::span<const Tetrahedron> by);
    /// Moves a corner that all of `star` have. False, and nothing has changed, if a cell would not be positive then.
    bool move(std::int32_t vertex, const Vec3& to, std::span<const std::int32_t> star);

    /// The number of a new vertex, which cells get by replace().
    std::int32_t add_vertex(const Vec3& p);
    /// One that no cell has.
    void remove_last_vertex();

 private:
    void find_limits(const std::function<void(const CellShape&)>& visit);
    double excess_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double six_volumes) const;

    SizeField max_size_;
    std::int64_t frozen_cells_;
    std::int32_t boundary_vertex_count_;
    bool had_neighbours_;
    double least_bound_six_ = 0;  // six times the least bound of volume; infinity: none
    double most_sharp_ = 0, most_flat_ = 0;
    EditableTets tets_;
    std::vector<double> badness_;
    mutable std::int64_t evaluations_ = 0;
    std::vector<char> is_fixed_;  // #V
};

}  // namespace kerf
