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

#include "core/types.h"
#include "surface/triangle_tree.h"

namespace kerf {

/// Triangles at which a mesh ends.
struct BoundaryTriangles {
    std::span<const Triangle> facets;    ///< #F
    std::span<const char> is_interface;  ///< #F; another part is on the other side, else it is of the user's surface
};

/// Tells which cells the user's surface forces to be sharp: those with a bound below 25 degrees that have at least a
/// quarter of it. No mesh that keeps the facets has a good cell there. A quarter, because a cell of a thin wall has its
/// fourth corner above one of the facet's, not above the centre, and then less than a third.
///
/// The bounds of a cell are the angles between two of its faces that are both facets, where it fills a sharp edge
/// alone, and atan(t / r) of each of its facets whose t does not end at an interface. That others are not forced is not
/// said: cells without facets between two walls that are near to each other are not counted.
class ForcedCells {
 public:
    /// Bounds above it force nothing: cells with larger angles are not bad (ImproveOptions::threshold_deg).
    static constexpr double largest_bound_deg = 25;
    /// The surface is not to blame for cells with less of their bound.
    static constexpr double least_share = 0.25;

    /// Keeps references to both. Corners must be vertices. O(#V + #F). Memory: 4 bytes a vertex, 8 a facet.
    ForcedCells(const std::vector<Vec3>& vertices, const BoundaryTriangles& boundary);

    /// Whether a cell with this smallest dihedral angle is forced. A flat one never is. About 1 us where it has facets
    /// and an angle below 25 degrees. The first call that needs it makes a tree of the facets: O(#F log #F).
    bool contains(const Tetrahedron& cell, double smallest_deg);

 private:
    bool is_on_surface(Triangle face) const;
    bool is_shallow(const Triangle& face, double cell_depth, double limit);

    const std::vector<Vec3>& vertices_;
    BoundaryTriangles boundary_;
    std::vector<std::int32_t> end_;       // #V + 1; of the facets of the user with a smallest corner below this vertex
    std::vector<UndirectedEdge> others_;  // the other two corners of each, by the smallest one
    std::optional<TriangleTree> tree_;
};

}  // namespace kerf
