// The division of facets that cross a coordinate plane.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cut/cut/cut.h"

namespace kerf {

/// The pieces of a triangle some of whose edges got a vertex.
struct TrianglePieces {
    std::array<Triangle, 3> pieces;
    int count = 0;
};

/// Returns the triangles that replace `t` if its edge from corner i to corner i + 1 gets the vertex on_edge[i]; -1
/// leaves an edge as it is, and at most two edges may be divided. The quadrilateral that two divided edges leave is
/// halved along the diagonal with the larger smallest angle, so the answer depends on the coordinates, and on the
/// numbers only where the angles are equal. Orientation is kept.
TrianglePieces split_triangle(const Triangle& t, const std::array<std::int32_t, 3>& on_edge,
                              const std::vector<Vec3>& vertices);

/// An edge with a new vertex between its ends.
struct SplitEdge {
    std::int32_t below, above;  ///< ends
    std::int32_t vertex;        ///< the new vertex
};

/// A closed surface after its facets have been split at a coordinate plane, so that none crosses it.
struct PlaneSplit {
    SurfaceArrays arrays;          ///< the surface's vertices, then the new ones with the keys (node, 0, 1, ...)
    std::vector<SplitEdge> edges;  ///< ascending by new vertex
    Array<Facet, Facet> parent;    ///< #F of `arrays`: the surface's facet that each comes from, ascending
    Array<Facet, Side> side;       ///< #F of `arrays`
};

/// Splits the facets that cross the plane x[axis] = height. Every crossed edge gets one new vertex, which is computed
/// once, from the edge's lower to its higher end, and has x[axis] = height exactly. Children keep key and patch of
/// their facet. Returns nothing if a vertex lies on the plane, or two new vertices fall together. Exact decisions.
/// O(#F).
std::optional<PlaneSplit> split_at_plane(const Surface& surface, int axis, double height, NodeId node);

}  // namespace kerf
