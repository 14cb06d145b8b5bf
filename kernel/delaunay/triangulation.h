// A triangulation of the convex hull of points, which grows point by point.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "delaunay/star_edges.h"
#include "mesh/editable_tets.h"

namespace kerf {

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

/// Of Triangulation::insert_if().
struct InsertionConditions {
    std::function<bool(const Star&)> accepts;
    /// Asked before all cells are known that the point would remove, which saves time where it says yes: whether the
    /// point may not come because of a constrained face that it sees. Empty: it may. Only once faces have been
    /// constrained or cells replaced. Must not throw, nor ask for cells.
    std::function<bool(const Triangle&)> is_kept_off_by = {};
    /// Where cells are not Delaunay already, not more need be removed: those nearest to the point by steps from cell to
    /// cell are.
    std::size_t most_removed = std::numeric_limits<std::size_t>::max();
};

/// Delaunay by the predicates of predicates.h, which know no ties, as long as no face was constrained and no cell
/// replaced by others. Outside of the hull there are ghosts. 32 bytes a cell and 29 a vertex, about 6.8 cells a vertex
/// in space.
class Triangulation : public EditableTets {
 public:
    /// A triangulation without cells, as of points that all lie in one plane.
    Triangulation() = default;
    /// One tetrahedron, of vertices 0 to 3. Requires orientation() 1. Never has more than `most` cells, at most
    /// most_cells.
    explicit Triangulation(const std::array<Vec3, 4>& corners, std::int32_t most = most_cells);

    /// Room for so many vertices, so that nothing is moved while they come.
    void reserve(std::size_t vertices);

    /// The cell in which a point lies; one of them if it lies on a face, an edge or a vertex. A ghost cell, whose face
    /// the point is strictly beyond, if it is outside. Walks from cell to cell towards it (devillers2002), starting at
    /// `hint`: about a dozen where the hint is near. Requires cells.
    std::int32_t locate(const Vec3& p, std::int32_t hint) const;
    /// What locate() finds, but none where the walk meets a constrained face or the hull.
    std::int32_t locate_in_sight(const Vec3& p, std::int32_t hint) const;
    /// The number of the new vertex; that of the old one if there is one at the point.
    ///
    /// Removes the cells in whose spheres the point lies, and joins it with the faces around them (bowyer1981,
    /// watson1981). Once faces have been constrained or cells replaced: what lies behind a constrained face is left as
    /// it is; cells whose faces the point cannot see are left, too; none, and nothing has changed, if the point lies on
    /// a constrained face or is not strictly inside of the hull. hint: a cell near the point; none for one of the last
    /// insertion's. About 3 us near the hint. Requires cells. Error (memory), and nothing has changed, if there might
    /// be too many: more than some 39 million vertices in space.
    std::int32_t insert(const Vec3& p, std::int32_t hint = none);
    /// Inserts the point under these conditions; none, and nothing has changed, if they do not hold.
    std::int32_t insert_if(const Vec3& p, std::int32_t hint, const InsertionConditions& conditions);

    /// The cells that the last insertion made: of each face in the order of Star::faces. Valid until the next change.
    const std::vector<std::int32_t>& made_cells() const { return made_; }

    /// Whether the last insertion has left cells as they were in whose spheres its point lies, because the point does
    /// not see all of their faces.
    bool has_left_cells() const { return has_left_cells_; }

    /// Gives vertex v the number number[v] in `points`, which has the same point there, and others that are no
    /// vertices. Linear.
    void renumber(const std::vector<std::int32_t>& number, std::vector<Vec3> points);

 private:
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
        std::array<StarEdges::Place, 3> place;  // of the vertices of the face, in the order of tet_faces
    };

    std::int32_t start_of(const Vec3& p, std::int32_t hint) const;
    bool ghost_conflicts(std::int32_t cell, const Vec3& p) const;
    bool conflicts(std::int32_t cell, const Vec3& p) const;
    Triangle cavity_face_vertices(CellFace face) const;
    int side_of(const Vec3& p, CellFace face) const;
    bool is_inside_cavity(CellFace behind) const {
        return (behind & constraint) == 0 && cells_[cell_of(behind)].is_marked();
    }
    bool find_cavity(const Vec3& p, std::int32_t start, const InsertionConditions& conditions);
    void grow_cavity(const Vec3& p, std::int32_t start);
    bool grow_cavity_in_sight(const Vec3& p, std::int32_t start, const InsertionConditions& conditions);
    void shrink_cavity(const Vec3& p);
    void unmark_cavity();
    std::int32_t insert_in_cavity(const Vec3& p);
    void place_cells();
    void set_cells(std::int32_t vertex);
    void join_cells();
    void join_cells_of_large_star();

    std::int32_t last_cell_ = 0;

    // Of the insertion under way.
    std::vector<std::int32_t> cavity_, made_;
    bool has_left_cells_ = false;
    std::vector<CellFace> unseen_;  // of cells of the cavity
    std::vector<CavityFace> cavity_faces_;
    std::vector<NewCell> new_cells_;
    Star star_;
    StarEdges star_edges_;
};

}  // namespace kerf
