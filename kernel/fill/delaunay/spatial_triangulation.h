// A triangulation of the convex hull of points, which grows point by point.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fill/delaunay/inside/star_edges.h"
#include "fill/mesh/editable_tets.h"

namespace kerf {

/// The effect of an insertion: the cells that a new point removes, and the faces with which it is joined.
struct Star {
    /// A face that makes a new cell with the point.
    struct Face {
        Triangle vertices;
        bool is_constrained;
    };
    std::vector<Face> faces;          ///< faces around the cells that are removed
    std::span<const CellId> removed;  ///< cells that are removed
};

/// The conditions of SpatialTriangulation::insert_if().
struct InsertionConditions {
    std::function<bool(const Star&)> accepts;  ///< whether the point may come, asked when its star is known
    /// Whether a constrained face that the point sees keeps it off. Asked before all cells that the point would remove
    /// are known, so that a yes saves time; only once faces have been constrained or cells replaced. Empty: no face
    /// keeps it off. Must not throw, nor ask for cells.
    std::function<bool(const Triangle&)> is_kept_off_by = {};
    /// Most cells to be removed, where cells are not Delaunay anyway: the nearest to the point are, by steps from cell
    /// to cell.
    std::size_t most_removed = std::numeric_limits<std::size_t>::max();
};

/// A triangulation that is Delaunay by the predicates of predicates.h, which know no ties, as long as no face was
/// constrained and no cell replaced by others. Outside of the hull there are ghosts. 32 bytes a cell and 29 a vertex,
/// about 6.8 cells a vertex in space.
class SpatialTriangulation : public EditableTets {
 public:
    /// A triangulation without cells, as of points that all lie in one plane.
    SpatialTriangulation() = default;
    /// Makes one tetrahedron, of vertices 0 to 3. Requires orientation() 1. There will never be more than `most` cells,
    /// at most most_cells.
    explicit SpatialTriangulation(const std::array<Vec3, 4>& corners, std::int32_t most = most_cells);

    /// Makes room for so many vertices, so that nothing is moved while they come.
    void reserve(std::size_t vertices);

    /// Returns the cell in which a point lies: one of them if it lies on a face, an edge or a vertex, and a ghost cell,
    /// whose face the point is strictly beyond, if it is outside. Walks from cell to cell towards it (Devillers, Pion
    /// and Teillaud 2002, devillers2002), starting at `hint`: about a dozen cells where the hint is near. Requires
    /// cells.
    CellId locate(const Vec3& p, CellId hint) const;
    /// Returns the cell of locate(), but none where the walk meets a constrained face or the hull.
    CellId locate_in_sight(const Vec3& p, CellId hint) const;
    /// Inserts a point. Returns the number of the new vertex, or that of the old one if there is one at the point.
    ///
    /// Removes the cells in whose spheres the point lies, and joins it with the faces around them (Bowyer 1981,
    /// bowyer1981; Watson 1981, watson1981). Once faces have been constrained or cells replaced, cells behind a
    /// constrained face are left as they are, and so are cells whose faces the point cannot see; the result is `none`,
    /// and nothing has changed, if the point lies on a constrained face or is not strictly inside of the hull. `hint`:
    /// a cell near the point; none for one that the last insertion made. About 3 us near the hint. Requires cells.
    /// Throws Error(memory), and nothing has changed, if there might be too many: more than some 39 million vertices in
    /// space.
    std::int32_t insert(const Vec3& p, CellId hint = CellId::none());
    /// Inserts a point under these conditions; returns `none`, and nothing has changed, if they do not hold.
    std::int32_t insert_if(const Vec3& p, CellId hint, const InsertionConditions& conditions);

    /// Returns the cells that the last insertion made, one for each face in the order of Star::faces. Valid until the
    /// next change.
    const std::vector<CellId>& made_cells() const { return made_; }

    /// Returns whether the last insertion has left some cells in whose spheres its point lies, because the point does
    /// not see all of their faces.
    bool has_left_cells() const { return has_left_cells_; }

    /// Gives vertex v the number number[v] in `points`, which has the same point there, and may have others that are no
    /// vertices. Linear.
    void renumber(const std::vector<std::int32_t>& number, std::vector<Vec3> points);

 private:
    // A face between a cell of the cavity and one that stays.
    struct CavityFace {
        CellFace inside;
        CellFace outside;  // name of the face from the other side, with `constraint` where it is constrained
    };
    // A new cell, in the place of the cell inside of such a face.
    struct NewCell {
        Tetrahedron vertex;
        CellFace face;  // face in the new cell, which tells where that is stored
        CellFace outside;
        std::array<StarEdges::Place, 3> place;  // places of the vertices of the face, in the order of tet_faces
    };

    CellId start_of(const Vec3& p, CellId hint) const;
    bool ghost_conflicts(CellId cell, const Vec3& p) const;
    bool conflicts(CellId cell, const Vec3& p) const;
    Triangle cavity_face_vertices(CellFace face) const;
    int side_of(const Vec3& p, CellFace face) const;
    bool is_inside_cavity(CellFace behind) const {
        return (behind & constraint) == 0 && cells_[cell_of(behind)].is_marked();
    }
    bool find_cavity(const Vec3& p, CellId start, const InsertionConditions& conditions);
    void grow_cavity(const Vec3& p, CellId start);
    bool grow_cavity_in_sight(const Vec3& p, CellId start, const InsertionConditions& conditions);
    void shrink_cavity(const Vec3& p);
    void unmark_cavity();
    std::int32_t insert_in_cavity(const Vec3& p);
    void place_cells();
    void set_cells(std::int32_t vertex);
    void join_cells();
    void join_cells_of_large_star();

    CellId last_cell_;

    // State of the insertion under way.
    std::vector<CellId> cavity_, made_;
    bool has_left_cells_ = false;
    std::vector<CellFace> unseen_;  // faces of cells of the cavity
    std::vector<CavityFace> cavity_faces_;
    std::vector<NewCell> new_cells_;
    Star star_;
    StarEdges star_edges_;
};

}  // namespace kerf
