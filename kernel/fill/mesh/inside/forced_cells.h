// Cells that are sharp because the body is.
//
// Two things bound the angles of all meshes that keep the facets of a surface. At a sharp edge the cells share the
// angle of the body, so that one of them has no more. And behind a facet there is one cell: let r be the radius of the
// largest circle in the facet, t the depth of the body behind the centre of the circle, and b the smallest of the three
// dihedral angles at the sides of the facet, which is below 90 degrees. There the cell is r tan b deep, which is no
// deeper than the body, so that b <= atan(t / r): facets that are large beside the thickness of a wall force flat
// cells.
//
// Needles among the facets force nothing: a long pyramid over one, as wide at its end as the needle is there, has no
// angle below 60 degrees.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/core/types.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

/// The triangles at which a mesh ends.
struct BoundaryTriangles {
    std::span<const Triangle> facets;  ///< #F
    /// #F; true if another part is on the other side of the triangle, false if it is of the user's surface.
    std::span<const char> is_interface;
};

/// Tells which cells the user's surface forces to be sharp: those with a bound below 25 degrees that have at least a
/// quarter of it. No mesh that keeps the facets has a good cell there. It is a quarter, because a cell of a thin wall
/// has its fourth corner above one of the facet's, not above the centre, and then less than a third.
///
/// The bounds of a cell are the angles between two of its faces that are both facets, where it fills a sharp edge
/// alone, and atan(t / r) of each of its facets whose t does not end at an interface. A cell that is not found may be
/// forced, too: cells without facets between two walls that are near to each other are not counted.
class ForcedCells {
 public:
    /// Largest bound that forces a cell: cells with larger angles are not bad (ImproveOptions::threshold_deg).
    static constexpr double largest_bound_deg = 25;
    /// Least share of its bound that a forced cell has: the surface is not to blame for cells with less.
    static constexpr double least_share = 0.25;

    /// Keeps references to both arguments. Corners must be vertices. O(#V + #F). Memory: 4 bytes a vertex, 8 a facet.
    ForcedCells(const std::vector<Vec3>& vertices, const BoundaryTriangles& boundary);

    /// Returns whether a cell with this smallest dihedral angle is forced. A flat one never is. About 1 us where it has
    /// facets and an angle below 25 degrees. The first call that needs it makes a tree of the facets: O(#F log #F).
    bool contains(const Tetrahedron& cell, double smallest_deg);

 private:
    bool is_on_surface(Triangle face) const;
    bool is_shallow(const Triangle& face, double cell_depth, double limit);

    const std::vector<Vec3>& vertices_;
    BoundaryTriangles boundary_;
    std::vector<std::int32_t> end_;  // #V + 1; number of the user's facets whose smallest corner is below this vertex
    std::vector<UndirectedEdge> others_;  // the other two corners of each of these facets, by the smallest one
    std::optional<TriangleTree> tree_;
};

}  // namespace kerf
