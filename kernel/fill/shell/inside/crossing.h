// The cells, faces and edges of a triangulation that are in the way of an edge or a triangle that it lacks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf {

/// The face or edge through which the line from one vertex to another leaves the cells around the first.
struct Crossing {
    /// Cell through which the line goes; the one with the end if there is one.
    CellId cell = CellId::none();
    CellFace face = SpatialTriangulation::none;  ///< face of the cell through which the line leaves
    /// Ends of the edge through which the line leaves, if it leaves through one.
    std::array<std::int32_t, 2> edge = {SpatialTriangulation::none, SpatialTriangulation::none};
    bool has_end = false;  ///< whether the edge from a to b is there

    bool is_through_edge() const { return edge[0] != SpatialTriangulation::none; }
};

/// Finds the place where the line from a to b leaves the cells around a. There is no cell where it meets a vertex
/// first. Exact. Linear in the number of cells around a.
Crossing crossing_of(SpatialTriangulation& triangulation, std::int32_t a, std::int32_t b);

/// Returns all that the line from a to b goes through, in its order, as long as it goes through the inside of faces;
/// the last crossing may be through an edge. Exact. Linear.
std::vector<Crossing> crossings_of(SpatialTriangulation& triangulation, std::int32_t a, std::int32_t b);

/// An edge that goes through the inside of a triangle.
struct PiercingEdge {
    CellId cell;  ///< cell with this edge and the triangle's first corner
    std::array<std::int32_t, 2> edge;
};

/// Finds edges that go through the inside of a triangle, opposite to its first corner. Where the triangle's own edges
/// are there, and it is no face, there is at least one. Exact. Linear in the number of cells around that corner.
std::vector<PiercingEdge> edges_through(SpatialTriangulation& triangulation, const Triangle& triangle);

/// Finds the face that is the triangle, seen from the cell that sees it clockwise; none if it is no face. Linear in the
/// number of cells around its first corner.
CellFace find_face(SpatialTriangulation& triangulation, const Triangle& triangle);

}  // namespace kerf
