// Planar facets with several polygons and holes as triangles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// A facet of a piecewise linear complex as TetGen defines it: polygons of three or more corners bound it, a polygon of
/// two corners is an edge inside of it, and one of a single corner a vertex inside of it.
struct PolygonalFacet {
    std::vector<std::vector<std::int64_t>> polygons;  ///< indices of vertices; at least one polygon, none empty
    std::vector<Vec3> holes;                          ///< points; the part of the facet around each is left out
};

struct FacetTriangulation {
    std::vector<Triangle> triangles;  ///< oriented as the polygon of the largest area; ascending
    std::string obstacle;      ///< the reason if there are no triangles, with coordinates, as the end of a sentence
                               ///< ("is not planar")
    std::int64_t outside = 0;  ///< polygons of one or two corners that lie in none of the triangles
};

/// Returns the constrained Delaunay triangulation of the area that the polygons enclose, seen along the axis that the
/// facet faces most. All polygons become edges or vertices of it, and there are no new vertices: a vertex that lies
/// exactly on an edge divides it. An inner polygon without a hole point divides the facet. Hole points are moved into
/// the plane.
///
/// Refused are facets that are not planar within rounding (as defined by find_fan()) or have no area, edges that cross,
/// and hole points on an edge. Exact predicates; deterministic, also where more than three vertices lie on a circle:
/// neither the order of polygons nor that of their corners matters. O(n log n) for n corners most of which lie near the
/// one before, plus the triangles that edges cross.
FacetTriangulation triangulate_facet(const std::vector<Vec3>& vertices, const PolygonalFacet& facet);

}  // namespace kerf
