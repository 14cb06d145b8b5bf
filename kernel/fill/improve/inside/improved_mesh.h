// A mesh that is made better: its cells, their badness, and the bounds of new cells.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fill/improve/cell_shape.h"
#include "fill/mesh/editable_tets.h"
#include "surface/size/size_field.h"

namespace kerf {

/// The cells of a mesh, their badness, and the conditions for new cells, see badness_of() and is_positive(). Numbers of
/// cells do not change until finish(). 40 bytes a cell and 29 a vertex.
class ImprovedMesh {
 public:
    static constexpr std::int32_t most_cells = EditableTets::most_cells;
    static constexpr std::size_t most_cells_of_a_ring = 10;

    /// Takes a mesh. Finds neighbours where it has none, and computes the shapes of all cells, which `visit` is told.
    /// The first `frozen_cells` cells never change. Throws Error(memory) if there are more than `most`, which is at
    /// most most_cells.
    ImprovedMesh(TetMesh mesh, std::int64_t frozen_cells, SizeField max_size,
                 const std::function<void(const CellShape&)>& visit, std::int32_t most = most_cells);
    /// Returns the mesh as it is now, without gaps among the cells, and with neighbours if it had some. Afterwards
    /// there are no cells.
    TetMesh finish();

    // --- cells and vertices ---

    std::int32_t cell_count() const { return tets_.cell_count(); }
    IdRange<CellId> cells() const { return tets_.cells(); }
    bool is_removed(CellId cell) const { return corners(cell)[0] < 0; }
    bool is_frozen(CellId cell) const { return cell.value() < frozen_cells_; }
    const Tetrahedron& corners(CellId cell) const { return tets_.vertices(cell); }
    const Vec3& point(std::int32_t vertex) const { return tets_.points()[vertex]; }
    double badness(CellId cell) const { return badness_[cell]; }
    /// Returns the cell behind the face opposite to corner i; not a valid one: the boundary.
    CellId neighbour(CellId cell, int i) const { return tets_.neighbour(cell, i); }
    /// Returns the face opposite to corner i, in the order that makes a positive cell after that corner.
    Triangle face(CellId cell, int i) const { return tets_.face_vertices(cell_face(cell, i)); }
    CellShape shape(const Tetrahedron& corners) const {
        return cell_shape(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3]));
    }
    /// Finds the cells around the edge between corners i and j of a cell. Returns false if the edge lies on the
    /// boundary, has a frozen cell, or more cells than most_cells_of_a_ring.
    bool find_ring(CellId cell, int i, int j, EdgeRing& ring) const;
    /// Finds the cells around the corner i of a cell. Returns false if the corner must not move.
    bool find_star(CellId cell, int i, std::vector<CellId>& star);

    // --- conditions of new cells ---

    /// Returns the largest ratio of volume to bound of these cells, at least 1: new cells in their place may have as
    /// much.
    double most_excess(std::span<const CellId> cells) const;
    /// Returns the badness of a new cell with these corners; infinity if it has an angle beyond all those of the mesh
    /// at the beginning, or exceeds its bound of volume by more than `excess`.
    double badness_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double excess) const;
    /// Returns how often badness_of() was asked: a measure of the work so far, without a clock.
    std::int64_t evaluations() const { return evaluations_; }
    bool is_positive(const Tetrahedron& corners) const;

    // --- changes ---

    /// Replaces cells by others, positive ones, that fill the same space and have the same faces around them. Returns
    /// the numbers of the new ones, valid until the next change. Throws Error(memory), and nothing has changed, if
    /// there would be too many.
    std::span<const CellId> replace(std::span<const CellId> cells, std::span<const Tetrahedron> by);
    /// Moves a corner that all of `star` have. Returns false, and nothing has changed, if a cell would not be positive
    /// then.
    bool move(std::int32_t vertex, const Vec3& to, std::span<const CellId> star);

    /// Adds a vertex and returns its number. It gets cells by replace().
    std::int32_t add_vertex(const Vec3& p);
    /// Removes the last vertex, which no cell may have.
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
    Array<CellId, double> badness_;
    mutable std::int64_t evaluations_ = 0;
    std::vector<char> is_fixed_;  // #V; whether a vertex must not move
};

}  // namespace kerf
