// A triangulation of the convex hull of points, which grows point by point.
//
// Every cell has four vertices and four neighbours; neighbour i lies across face i, opposite to vertex i. Outside of
// the hull there is a ghost cell on each of its faces, whose fourth vertex is the ghost: so every face has two cells. A
// face seen from one of its two cells is named by 4 * cell + i, as half-edges are on a surface.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/types.h"
#include "delaunay/star_edges.h"

namespace kerf {

/// 4 * cell + i: the face of the cell that is opposite to its vertex i.
using CellFace = std::int32_t;

constexpr CellFace cell_face(std::int32_t cell, int i) { return 4 * cell + i; }
constexpr std::int32_t cell_of(CellFace face) { return face >> 2; }
constexpr int index_in_cell(CellFace face) { return face & 3; }

/// What an insertion would do.
struct Star {
    /// (point, vertices) is a new cell.
    struct Face {
        Triangle vertices;
        bool is_constrained;
    };
    std::vector<Face> faces;                ///< around the cells that are removed
    std::span<const std::int32_t> removed;  ///< these cells
};

/// Delaunay by the predicates of predicates.h, which know no ties, as long as no face was constrained. All answers and
/// the numbers of cells depend on the calls alone. Cells are always numbered from 0 without gaps; an insertion may give
/// any cell another number. 32 bytes a cell and 29 a vertex, about 6.8 cells a vertex in space.
class Triangulation {
 public:
    static constexpr std::int32_t ghost = -1, none = -1;
    /// Faces of cells are numbered by 30 bits.
    static constexpr std::int32_t most_cells = 1 << 28;

    /// Without cells: where all points lie in one plane.
    Triangulation() = default;
    /// One tetrahedron, of vertices 0 to 3. Requires orientation() 1. Never has more than `most` cells, at most
    /// most_cells.
    explicit Triangulation(const std::array<Vec3, 4>& corners, std::int32_t most = most_cells);

    /// Room for so many vertices, so that nothing is moved while they come.
    void reserve(std::size_t vertices);

    // --- what there is ---

    const std::vector<Vec3>& points() const { return points_; }
    /// Ghost cells included.
    std::int32_t cell_count() const { return static_cast<std::int32_t>(cells_.size()); }
    bool is_ghost(std::int32_t cell) const { return cells_[cell].vertex[3] < 0; }
    /// Of positive orientation. The ghost is always vertex 3, and would see the others counter-clockwise.
    const Tetrahedron& vertices(std::int32_t cell) const { return cells_[cell].vertex; }
    std::int32_t neighbour(std::int32_t cell, int i) const { return cell_of(mirror(cell_face(cell, i))); }
    /// The same face seen from its other cell.
    CellFace mirror(CellFace face) const { return link(face) & ~constraint; }
    std::int32_t opposite_vertex(CellFace face) const { return cells_[cell_of(face)].vertex[index_in_cell(face)]; }
    /// One of the cells around a vertex; none if it has no cells.
    std::int32_t cell_at(std::int32_t vertex) const { return cell_at_vertex_[vertex]; }
    /// Of a face that is not the ghost's, counter-clockwise seen from outside of the cell.
    Triangle face_vertices(CellFace face) const;
    /// Which of its four vertices the vertex is; 4 if none.
    int index_of(std::int32_t cell, std::int32_t vertex) const;
    /// All cells around a vertex that has some, ghosts included. Linear.
    std::vector<std::int32_t> cells_around_vertex(std::int32_t vertex);
    /// All cells around the edge from vertex i to vertex j of a cell, ghosts included, one after the other: the first
    /// is the cell itself, each shares a face with the next. They turn counter-clockwise seen from j.
    std::vector<std::int32_t> cells_around_edge(std::int32_t cell, int i, int j) const;

    // --- faces that stay ---

    bool is_constrained(CellFace face) const { return (link(face) & constraint) != 0; }
    /// Both sides of it. From then on insert() never removes the face, see there.
    void constrain(CellFace face);

    // --- regions ---

    /// A number of each cell, 0 at first. As no insertion reaches across constrained faces, new cells have that of the
    /// ones that they replace.
    std::uint8_t region(std::int32_t cell) const { return regions_.empty() ? 0 : regions_[cell]; }
    void set_region(std::int32_t cell, std::uint8_t region);

    // --- cells in place of others ---

    /// Replaces cells by others that fill the same space and have the same faces around them, constrained or not; the
    /// cells' own faces must not be constrained. Ghost cells may be among both. Only with regions of one number. Error
    /// (memory), and nothing has changed, if there would be too many.
    void replace(std::span<const std::int32_t> cells, std::span<const Tetrahedron> by);

    /// A vertex without cells, for replace(): its number.
    std::int32_t add_vertex(const Vec3& p);
    /// Forgets the last vertices, which must have no cells, so that `count` are left.
    void remove_unused_vertices(std::size_t count);

    // --- points ---

    /// The cell in which a point lies; one of them if it lies on a face, an edge or a vertex. A ghost cell, whose face
    /// the point is strictly beyond, if it is outside. Walks from cell to cell towards it (devillers2002), starting at
    /// `hint`: about a dozen where the hint is near. Requires cells.
    std::int32_t locate(const Vec3& p, std::int32_t hint) const;
    /// The same, but none where the walk meets a constrained face or the hull.
    std::int32_t locate_in_sight(const Vec3& p, std::int32_t hint) const;
    /// The number of the new vertex; that of the old one if there is one at the point.
    ///
    /// Removes the cells in whose spheres the point lies, and joins it with the faces around them (bowyer1981,
    /// watson1981). What lies behind a constrained face is left as it is; cells whose faces the point cannot see are
    /// left, too. none, and nothing has changed, if there are constrained faces, and the point lies on one or is not
    /// strictly inside of the hull. hint: a cell near the point; none for one of the last insertion's. About 3 us near
    /// the hint. Requires cells. Error (memory), and nothing has changed, if there might be too many: more than
    /// some 39 million vertices in space.
    std::int32_t insert(const Vec3& p, std::int32_t hint = none);
    /// The same if `accepts` says so; none, and nothing has changed, if it does not.
    std::int32_t insert_if(const Vec3& p, std::int32_t hint, const std::function<bool(const Star&)>& accepts);

    /// Gives vertex v the number number[v] in `points`, which has the same point there, and others that are no
    /// vertices. Linear.
    void renumber(const std::vector<std::int32_t>& number, std::vector<Vec3> points);

 private:
    struct Cell {
        Tetrahedron vertex;
        std::array<CellFace, 4> link;  // neighbours, with `constraint` where the face is constrained

        // Cells of the cavity, while it grows.
        bool is_marked() const { return vertex[0] < 0; }
        void flip_mark() { vertex[0] = ~vertex[0]; }
    };
    // A face between a cell of the cavity and one that stays.
    struct CavityFace {
        CellFace inside;
        CellFace outside;  // and `constraint`
    };
    // What replaces the cell inside of such a face.
    struct NewCell {
        Tetrahedron vertex;
        CellFace face;  // and where the cell is stored
        CellFace outside;
        std::array<StarEdges::Place, 4> place;
    };

    static constexpr CellFace constraint = 1 << 30;

    CellFace link(CellFace face) const { return cells_[cell_of(face)].link[index_in_cell(face)]; }
    CellFace& link(CellFace face) { return cells_[cell_of(face)].link[index_in_cell(face)]; }
    void prefetch(std::int32_t cell) const { __builtin_prefetch(&cells_[cell]); }
    int orientation_with(const Tetrahedron& vertex, int i, const Vec3& p) const;
    bool sphere_contains(std::int32_t cell, const Vec3& p) const;
    bool conflicts(std::int32_t cell, const Vec3& p) const;
    std::int32_t vertex_at(const Vec3& p, std::int32_t cell) const;
    int face_towards(const Vec3& p, std::int32_t cell, int came_from, int first) const;

    template <bool stops_at_constraints>
    std::int32_t walk(const Vec3& p, std::int32_t hint) const;
    bool find_cavity(const Vec3& p, std::int32_t start);
    void grow_cavity(const Vec3& p, std::int32_t start);
    void release_cavity();
    bool may_be_removed(std::int32_t cell, const Vec3& p) const;
    bool refuse_unseen_cells(const Vec3& p);
    void fill_cavity(std::int32_t vertex);
    void place_cells();
    void set_cell(const NewCell& made, std::int32_t vertex);
    void join_cells();
    void join_cells_of_large_star();
    std::int32_t insert_in_cavity(const Vec3& p);
    void require_room(std::size_t more_cells) const;
    void remove_cells(std::vector<std::int32_t> cells);
    void move_cell(std::int32_t from, std::int32_t to);

    std::vector<Vec3> points_;
    std::vector<Cell> cells_;
    std::vector<std::int32_t> cell_at_vertex_;
    std::vector<std::uint8_t> regions_;  // of each cell; empty: all 0
    std::int32_t most_ = most_cells, last_cell_ = 0;
    bool has_constraints_ = false;

    // Of the insertion under way.
    std::vector<std::int32_t> cavity_, refused_;
    std::vector<CavityFace> cavity_faces_;
    std::vector<NewCell> new_cells_;
    Star star_;
    StarEdges star_edges_;
};

}  // namespace kerf
