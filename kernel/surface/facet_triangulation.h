// Planar facets with several polygons and holes as triangles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"

namespace kerf {

/// A facet of a piecewise linear complex, as TetGen has them: polygons of three or more corners bound it, one of two
/// corners is an edge inside of it, one of a single corner a vertex inside of it.
struct PolygonalFacet {
    std::vector<std::vector<std::int64_t>> polygons;  ///< indices of vertices; at least one polygon, none empty
    std::vector<Vec3> holes;                          ///< what lies around one of these points is left out
};

struct FacetTriangulation {
    std::vector<Triangle> triangles;  ///< oriented as the polygon of the largest area; ascending
    std::string obstacle;      ///< if there are none: why, with coordinates, as the end of a sentence ("is not planar")
    std::int64_t outside = 0;  ///< polygons of one or two corners that lie in none of the triangles
};

/// The constrained Delaunay triangulation of what polygons enclose, seen along the axis that the facet faces most. All
/// polygons become edges or vertices of it, and there are no new vertices: a vertex that lies exactly on an edge
/// divides it. An inner polygon without a hole point divides the facet. Hole points are moved into the plane.
///
/// Refused are facets that are not planar within rounding (as find_fan() has it) or have no area, edges that cross and
/// hole points on an edge. Exact predicates; deterministic, also where more than three vertices lie on a circle:
/// neither the order of polygons nor that of their corners matters. O(n log n) for n corners that mostly lie near to
/// the one before, plus the triangles that edges cross.
FacetTriangulation triangulate_facet(const std::vector<Vec3>& vertices, const PolygonalFacet& facet);

}  // namespace kerf
