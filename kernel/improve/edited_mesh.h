// A tetrahedral mesh whose cells are replaced by others with the same boundary.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "improve/cell_shape.h"
#include "mesh/tet_mesh.h"
#include "size/size_field.h"

namespace kerf {

/// Cells around an edge from a to b: cell i has the corners a, b, ring[i] and ring[i+1], in positive order.
struct EdgeRing {
    static constexpr std::size_t most_cells = 10;
    std::int32_t a = 0, b = 0;
    std::size_t size = 0;
    std::array<std::int32_t, most_cells> cells, ring;
};

/// Edits the arrays of a TetMesh. Numbers of cells do not change until finish(); those that have been removed are used
/// again. 28 bytes a cell beside the mesh.
///
/// What new cells must be is asked here: see badness_of() and is_positive().
class EditedMesh {
 public:
    /// Faces are numbered by 31 bits.
    static constexpr std::size_t most_cells = std::size_t{1} << 29;

    /// Finds neighbours where the mesh has none, and looks at the shapes of all cells, which `visit` is told. The first
    /// `frozen_cells` cells never change. Error (memory) if there are more than `most`, which is at most most_cells.
    EditedMesh(TetMesh& mesh, std::int64_t frozen_cells, SizeField max_size,
               const std::function<void(const CellShape&)>& visit, std::size_t most = most_cells);

    // --- what there is ---

    std::int32_t cell_count() const { return static_cast<std::int32_t>(mesh_->tets.size()); }
    bool is_removed(std::int32_t cell) const { return mesh_->tets[cell][0] < 0; }
    bool is_frozen(std::int32_t cell) const { return cell < frozen_cells_; }
    const Tetrahedron& corners(std::int32_t cell) const { return mesh_->tets[cell]; }
    const Vec3& point(std::int32_t vertex) const { return mesh_->vertices[vertex]; }
    double badness(std::int32_t cell) const { return badness_[cell]; }
    /// Behind the face opposite to corner i; below 0: the boundary.
    std::int32_t neighbour(std::int32_t cell, int i) const { return links_[cell][i] < 0 ? none : links_[cell][i] >> 2; }
    /// Opposite to corner i, and positive after it.
    Triangle face(std::int32_t cell, int i) const {
        const auto& [p, q, r] = tet_faces[i];
        return {corners(cell)[p], corners(cell)[q], corners(cell)[r]};
    }
    CellShape shape(const Tetrahedron& corners) const {
        return cell_shape(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3]));
    }
    /// Those around the edge between corners i and j of a cell. False if it lies on the boundary, has a frozen cell, or
    /// more cells than there is room for.
    bool find_ring(std::int32_t cell, int i, int j, EdgeRing& ring) const;
    /// Those around the corner i of a cell. False if the corner must not move.
    bool find_star(std::int32_t cell, int i, std::vector<std::int32_t>& star);

    // --- what may be ---

    /// The largest volume over its bound of these cells, at least 1: what new ones in their place may have.
    double most_excess(std::span<const std::int32_t> cells) const;
    /// The badness of a new cell with these corners; infinity if it has an angle beyond all that there were, or exceeds
    /// its bound of volume more.
    double badness_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double excess) const;
    /// How often badness_of() was asked: what it has cost so far, without a clock.
    std::int64_t looks() const { return looks_; }
    bool is_positive(const Tetrahedron& corners) const;

    // --- changes ---

    /// Replaces cells by others, positive ones, that fill the same space and have the same faces around them. Appends
    /// the numbers of the new ones to `made`. Error (memory), and nothing has changed, if there would be too many.
    void replace(std::span<const std::int32_t> cells, std::span<const Tetrahedron> by, std::vector<std::int32_t>& made);
    /// Moves a corner that all of `star` have. False, and nothing has changed, if a cell would not be positive then.
    bool move(std::int32_t vertex, const Vec3& to, std::span<const std::int32_t> star);

    /// The number of a new vertex, which cells get by replace().
    std::int32_t add_vertex(const Vec3& p);
    /// One that no cell has.
    void remove_last_vertex();

    /// Closes the gaps among the cells, and gives the mesh neighbours if it had some.
    void finish();

 private:
    static constexpr std::int32_t none = -1;
    struct OpenFace {
        Triangle vertices;  // ascending
        std::int32_t side;  // 4 * cell + i of one of its cells; none
    };

    void find_links();
    void copy_links();
    void find_limits(const std::function<void(const CellShape&)>& visit);
    double excess_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double six_volumes) const;
    double excess_of(std::int32_t cell) const;
    std::int32_t take_cell();
    void open_faces(std::span<const std::int32_t> cells);
    void close_face(std::int32_t side);
    Triangle face_key(std::int32_t cell, int i) const;
    void restore_neighbours();
    void require_room(std::size_t cells) const;

    TetMesh* mesh_;
    SizeField max_size_;
    std::int64_t frozen_cells_;
    std::size_t most_;
    bool had_neighbours_;
    double least_bound_six_ = 0;  // six times the least bound of volume; infinity: none
    double most_sharp_ = 0, most_flat_ = 0;
    std::vector<std::array<std::int32_t, 4>> links_;  // 4 * cell + i of the other side; below 0: none
    std::vector<double> badness_;
    std::vector<std::uint32_t> seen_;  // in which search
    std::uint32_t search_ = 0;
    mutable std::int64_t looks_ = 0;
    std::vector<std::int32_t> free_;
    std::vector<OpenFace> open_;
    std::vector<char> is_fixed_;  // #V
};

}  // namespace kerf
