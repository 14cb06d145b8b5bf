// Triangulations of rims over their vertices alone.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The plane in which a rim is nearly a polygon.
struct RimPlane {
    Vec3 centre = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  ///< unit vector, counter-clockwise around the rim; zero if the rim encloses no area
    double area = 0;             ///< area that the rim encloses in the plane
    double height = 0;           ///< the largest distance of the rim from the plane
};
/// Returns the plane of a rim, through the mean of its vertices and across its area vector.
RimPlane rim_plane(const std::vector<Vec3>& rim);

/// Whether the heights above the plane may be rounding alone: they are below a millionth of the width.
bool is_planar(const RimPlane& plane, const std::vector<Vec3>& rim);

/// Returns triangles over positions in a closed rim, in its direction; empty if there are none. A planar rim gets its
/// constrained Delaunay triangulation, others the triangulation whose largest angle between neighbours is the smallest
/// (Liepa 2003, liepa2003), by triangulate_hole(). That takes O(n^3) at worst: a rim of more than 100 vertices is
/// triangulated in the plane where it is nearly planar, and otherwise divided by the shortest chord that leaves a
/// quarter of it on either side. `apexes`: the third corner of the facet at each edge. Deterministic.
std::vector<Triangle> triangulate_rim(const std::vector<Vec3>& rim, const std::vector<Vec3>& apexes);

/// Returns the triangles of a band between two rims of opposite directions, over positions in the first, then in the
/// second, counted on. The band begins at the shortest edge between them, and goes on by the shorter one of two. O(n1
/// n2) with little to do.
std::vector<Triangle> triangulate_band(const std::vector<Vec3>& first, const std::vector<Vec3>& second);

}  // namespace kerf
