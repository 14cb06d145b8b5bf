// Tetrahedra that are replaced by others, and always know their neighbours.
//
// Every cell has four vertices and four links; link i leads across face i, opposite to vertex i. A face seen from one
// of its two cells is named by 4 * cell + i, as half-edges are on a surface. A link is the name of the same face seen
// from the other side, with a flag where the face is constrained, or it is below 0 where there is no cell behind.
//
// Delaunay insertion (fill/delaunay/spatial_triangulation.h) and improvement (fill/improve/inside/improved_mesh.h) are
// built on this. They change cells in three steps: find_ring() or find_star() finds the cells around an edge or a
// vertex, the caller chooses new cells as Tetrahedron, and replace() puts these in their place.
#pragma once

#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "base/core/ids.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

/// 4 * cell + i: the face of the cell that is opposite to its vertex i.
using CellFace = std::int32_t;

constexpr CellFace cell_face(CellId cell, int i) { return 4 * cell.value() + i; }
constexpr CellId cell_of(CellFace face) { return CellId(face >> 2); }
constexpr int index_in_cell(CellFace face) { return face & 3; }

/// Returns the place of a vertex or cell among four different ones; 4 if it is none of them. Without branches, which
/// could not be predicted.
template <class T>
inline int index_of(const std::array<T, 4>& items, T item) {
    const int matches =
        (items[0] == item) | (items[1] == item) << 1 | (items[2] == item) << 2 | (items[3] == item) << 3;
    return std::countr_zero(static_cast<unsigned>(matches | 1 << 4));
}

/// The two vertices of a cell that are neither i nor j, as other_two[i][j]: (i, j, first, second) is an even
/// permutation.
inline constexpr std::array<std::array<std::array<int, 2>, 4>, 4> other_two = {{{{{0, 0}, {2, 3}, {3, 1}, {1, 2}}},
                                                                                {{{3, 2}, {0, 0}, {0, 3}, {2, 0}}},
                                                                                {{{1, 3}, {3, 0}, {0, 0}, {0, 1}}},
                                                                                {{{2, 1}, {0, 2}, {1, 0}, {0, 0}}}}};

/// Cells of positive orientation, and points, their vertices. All answers and the numbers of cells depend on the calls
/// alone. 32 bytes a cell and 28 a vertex.
///
/// Cells that are made of points may have ghosts: cells outside of the hull, one on each of its faces, whose vertex 3
/// is the ghost, so that every face has two cells. They are numbered from 0 without gaps; a change may give any cell
/// another number. Cells that are made of a TetMesh have no ghosts, and keep their numbers until take_mesh(); those
/// that have been removed leave gaps, which new cells fill.
class EditableTets {
 public:
    /// The ghost as a vertex, and the number of no vertex and of no face.
    static constexpr std::int32_t ghost = -1, none = -1;
    /// Faces of cells are numbered by 30 bits.
    static constexpr std::int32_t most_cells = 1 << 28;

    /// Takes points without cells. There will never be more than `most` cells, which is at most most_cells.
    explicit EditableTets(std::vector<Vec3> points = {}, std::int32_t most = most_cells);
    /// Takes the cells of a mesh. Finds their neighbours where the mesh has none. Throws Error(memory) if there are
    /// more than `most`. Linear.
    EditableTets(TetMesh mesh, std::int32_t most);
    /// Returns the cells, which must have no ghosts, in order, and all points; with neighbours if they are asked for,
    /// none across constrained faces. Afterwards there are no cells. boundary_vertex_count is left to the caller.
    /// Linear.
    TetMesh take_mesh(bool with_neighbours);

    // --- cells, faces and vertices ---

    const std::vector<Vec3>& points() const { return points_; }
    /// Returns the number of cells, ghosts and gaps included.
    std::int32_t cell_count() const { return count_of(cells_); }
    IdRange<CellId> cells() const { return cells_.ids(); }
    bool is_ghost(CellId cell) const { return cells_[cell].vertex[3] < 0; }
    /// Returns the vertices of a cell. The ghost is always vertex 3, and would see the others counter-clockwise. In a
    /// gap the first vertex is below 0.
    const Tetrahedron& vertices(CellId cell) const { return cells_[cell].vertex; }
    /// Returns the name of a face seen from its other cell; below 0 where there is none.
    CellFace mirror(CellFace face) const { return cells_[cell_of(face)].link[index_in_cell(face)] & ~constraint; }
    /// Returns the cell behind the face opposite to vertex i; not a valid one where there is none.
    CellId neighbour(CellId cell, int i) const { return cell_of(mirror(cell_face(cell, i))); }
    std::int32_t opposite_vertex(CellFace face) const { return cells_[cell_of(face)].vertex[index_in_cell(face)]; }
    /// Returns the vertices of a face that is not the ghost's, counter-clockwise seen from outside of the cell.
    Triangle face_vertices(CellFace face) const {
        const Tetrahedron& corners = cells_[cell_of(face)].vertex;
        const auto& [i, j, k] = tet_faces[index_in_cell(face)];
        return {corners[i], corners[j], corners[k]};
    }
    /// Returns one of the cells around a vertex; none if it has no cells.
    CellId cell_at(std::int32_t vertex) const { return cell_at_vertex_[vertex]; }
    /// Returns all cells around a vertex, ghosts included. The vertex must have cells and be on no face without a cell
    /// behind. Linear.
    std::vector<CellId> cells_around_vertex(std::int32_t vertex);
    /// Puts all cells around a vertex into `star`, whose memory is used again. The given cell must be one of them, and
    /// is the first.
    void find_star(CellId cell, std::int32_t vertex, std::vector<CellId>& star);

    // --- faces that stay ---

    /// Returns whether a face is constrained, as every face without a cell behind is.
    bool is_constrained(CellFace face) const {
        return (cells_[cell_of(face)].link[index_in_cell(face)] & constraint) != 0;
    }
    /// Constrains both sides of a face.
    void constrain(CellFace face);

    // --- changes ---

    /// Replaces cells by others that fill the same space and have the same faces around them, constrained or not; faces
    /// between the cells must not be constrained. Ghost cells may be among both. Returns the numbers of the new cells,
    /// in the order of `by`; they are valid until the next change. Throws Error(memory), before anything has changed,
    /// if there would be too many. Quadratic in the number of faces.
    std::span<const CellId> replace(std::span<const CellId> cells, std::span<const Tetrahedron> by);
    /// Removes all cells but those with `is_kept`, which must have no ghosts and keep their order. Faces between kept
    /// and removed cells have no cell behind them then. Linear.
    void keep_cells(const std::vector<bool>& is_kept);
    /// Adds cells where there are none, and joins them with others at common faces behind which there is no cell.
    void add_cells(std::span<const Tetrahedron> cells);

    /// Adds a vertex and returns its number. It gets cells by replace().
    std::int32_t add_vertex(const Vec3& p);
    /// Moves a vertex. The cells around it must stay positive.
    void move_vertex(std::int32_t vertex, const Vec3& to) { points_[vertex] = to; }
    /// Forgets the last vertices, which must have no cells, so that `count` are left.
    void remove_unused_vertices(std::size_t count);

 protected:
    struct alignas(32) Cell {  // lies in one line of the cache
        Tetrahedron vertex;
        std::array<CellFace, 4> link;  // other sides of the faces, with `constraint` where a face is constrained

        // A mark for searches: vertex 0, which is never the ghost, is complemented.
        bool is_marked() const { return vertex[0] < 0; }
        void flip_mark() { vertex[0] = ~vertex[0]; }
    };

    static constexpr CellFace constraint = 1 << 30;

    CellFace& link(CellFace face) { return cells_[cell_of(face)].link[index_in_cell(face)]; }
    void require_room(std::size_t more_cells) const;
    // Removes cells. The last cells move to their places, and numbers in `followed` are changed with them.
    void remove_cells(std::span<const CellId> cells, std::span<CellId> followed);

    std::vector<Vec3> points_;
    Array<CellId, Cell> cells_;
    std::vector<CellId> cell_at_vertex_;
    std::int32_t most_ = most_cells;
    bool is_altered_ = false;  // whether faces were constrained, or cells replaced

 private:
    // A face of which one side is known so far.
    struct OpenFace {
        Triangle vertices;  // ascending
        CellFace side;      // known side, with `constraint` for faces that stay
    };

    bool keeps_numbers_ = false;
    std::vector<CellId> gaps_;  // places of removed cells; the last one is filled first
    std::vector<CellId> places_;
    std::vector<OpenFace> open_;
};

/// The cells around an edge from a to b: cell i has the corners a, b, ring[i] and ring[i + 1], in positive order; the
/// ghost may be among the ring.
struct EdgeRing {
    std::int32_t a = 0, b = 0;
    std::vector<CellId> cells;
    std::vector<std::int32_t> ring;

    std::size_t size() const { return cells.size(); }
    /// Returns the place of a vertex in the ring; size() if it has none.
    std::size_t place_of(std::int32_t vertex) const;
};

/// Finds the ring of the edge from vertex i to vertex j of a cell, which is the first in it. Cells turn
/// counter-clockwise seen from b. Returns false if there is a face without a cell behind, or more cells than `most`.
bool find_ring(const EditableTets& tets, CellId cell, int i, int j, EdgeRing& ring,
               std::size_t most = std::numeric_limits<std::size_t>::max());

/// Returns whether the face between cells k - 1 and k of a ring is constrained.
bool is_spoke_constrained(const EditableTets& tets, const EdgeRing& ring, std::size_t k);

}  // namespace kerf
