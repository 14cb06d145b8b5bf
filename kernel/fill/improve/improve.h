// Better tetrahedra inside of the same boundary.
#pragma once

#include <functional>

#include "fill/mesh/quality.h"
#include "fill/mesh/tet_mesh.h"
#include "surface/size/size_field.h"

namespace kerf {

struct ImproveOptions {
    /// The angle below which a dihedral angle makes a cell bad, and so does one above 180 degrees less this. In (0,
    /// 70).
    double threshold_deg = 25;
    SizeField max_size = {};        ///< hard bound of volumes, asked at the centroids of cells; empty: none
    std::int64_t frozen_cells = 0;  ///< the first so many cells stay as they are, with their numbers
    int most_rounds = 3;            ///< most rounds over all bad cells; it ends sooner where a round gains little
    /// The budget: number of new cells that may be looked at for each cell of the mesh, made or not. 5 to 8 are enough
    /// on good surfaces; where flips had to recover a fifth of the facets, 100 are.
    double evaluation_budget = 100;
    bool adds_vertices = true;                ///< whether vertices are added where nothing else helps
    std::function<bool()> is_cancelled = {};  ///< asked every few milliseconds; empty: never
};

/// The operations of improve(), and the cells before and after.
struct Improvement {
    std::int64_t removed_edges = 0, moved_vertices = 0, new_vertices = 0;  ///< numbers of operations
    std::int64_t bad_cells_before = 0, bad_cells_after = 0;  ///< numbers of bad cells, without frozen ones
    std::int32_t rounds = 0;                                 ///< number of rounds; of several meshes, the largest
    /// Distribution of the smallest dihedral angles of all cells as they were, in degrees.
    Distribution smallest_before;

    /// Adds the operations and cells of another mesh.
    void add(const Improvement& other);
    /// Adds the operations of a second pass over the same mesh, but not its bad cells, which may be by another
    /// threshold.
    void add_operations(const Improvement& again);
    /// Returns whether no mesh has been counted.
    bool is_empty() const { return smallest_before.count() == 0; }

    template <class Archive>
    void archive(Archive& a) {
        a(removed_edges, moved_vertices, new_vertices, bad_cells_before, bad_cells_after, rounds, smallest_before);
    }
};

/// Improves cells that are worse than the threshold, the worst first: edges are removed (Klincsek 1980, klincsek1980;
/// Freitag and Ollivier-Gooch 1997, freitag1997; Shewchuk 2002, shewchuk2002), and where none can be, vertices are
/// moved (freitag1997; Klingner and Shewchuk 2007, klingner2007). From the second round on, where that does not help
/// and an angle is below 20 degrees, or above 160, a vertex is added (klingner2007); below 12 or above 168 where sizes
/// differ from place to place, which more vertices would not obey. A new vertex must leave no cell below 8 degrees, 3
/// in later rounds, or vertices would crowd where the surface allows no better; in the place of a sharper cell it may
/// leave cells of 1.7 times its angle. Below 3 degrees the vertex may begin under the facets of the cell, too, and only
/// the whole budget ends the tries. Cells below 0.01 degrees, whose volume is lost in rounding, come first and are
/// given up last. Flips of single faces are not tried: of 600,000 bad cells of the assets they helped three that the
/// others did not.
///
/// All faces that have a cell on one side only stay, as do the vertices on them, the first boundary_vertex_count
/// vertices, and those of frozen cells; no vertex is removed or gets another number, new ones come last. Cells that are
/// left keep their order.
///
/// An operation makes the worst of the cells that it replaces better, by the smaller one of the smallest dihedral angle
/// and of the angle that the largest one lacks to 180 degrees. It makes no cell that is not positively oriented
/// (exactly), none with an angle that is smaller than all angles of the mesh were, or larger, and none above the bound
/// of volume, unless one of those that it replaces exceeded its own bound as much. So the extreme angles of the mesh
/// never get worse; other angles may.
///
/// Requires a mesh that obeys its laws (fill/mesh/verification.h) but for neighbours, which it may have or not, and
/// then has or not afterwards. Deterministic; the result depends on the order of cells, its validity does not. Throws
/// Error(cancelled), and the mesh is valid, but not finished. Throws Error(memory), and nothing has changed, for more
/// than 2^28 cells. About 0.2 us a cell and 5 us a bad one, at most 10 us a cell where evaluation_budget is 100.
/// Memory: 33 bytes a cell beside the mesh.
Improvement improve(TetMesh& mesh, const ImproveOptions& options = {});

}  // namespace kerf
