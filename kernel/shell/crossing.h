// What of a triangulation is in the way of an edge or a triangle that it lacks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/triangulation.h"

namespace kerf {

/// Where the line from a vertex to another one leaves the cells around the first.
struct Crossing {
    std::int32_t cell = Triangulation::none;  ///< the line goes through it; the one with the end if there is one
    CellFace face = Triangulation::none;      ///< of the cell, through which it leaves
    std::array<std::int32_t, 2> edge = {Triangulation::none, Triangulation::none};  ///< if it leaves through an edge
    bool has_end = false;                                                           ///< the edge is there

    bool is_through_edge() const { return edge[0] != Triangulation::none; }
};

/// Finds where the line from a to b leaves the cells around a. There is no cell where it meets a vertex first. Exact.
/// Linear in the number of cells around a.
Crossing crossing_of(Triangulation& triangulation, std::int32_t a, std::int32_t b);

/// What the line from a to b goes through, in its order, as long as it goes through the inside of faces; the last one
/// may be an edge. Exact. Linear.
std::vector<Crossing> crossings_of(Triangulation& triangulation, std::int32_t a, std::int32_t b);

/// An edge that goes through the inside of a triangle.
struct PiercingEdge {
    std::int32_t cell;  ///< has it, and the triangle's first corner
    std::array<std::int32_t, 2> edge;
};

/// Finds edges that go through the inside of a triangle, opposite to its first corner. Where the triangle's own edges
/// are there, and it is no face, there is one at least. Exact. Linear in the number of cells around that corner.
std::vector<PiercingEdge> edges_through(Triangulation& triangulation, const Triangle& triangle);

/// Finds the face that is the triangle, seen from the cell that sees it clockwise; none if there is none. Linear in the
/// number of cells around its first corner.
CellFace find_face(Triangulation& triangulation, const Triangle& triangle);

}  // namespace kerf
