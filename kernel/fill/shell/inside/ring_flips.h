// The cells around an edge, and flips that replace them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fill/delaunay/spatial_triangulation.h"
#include "fill/shell/inside/goal.h"

namespace kerf {

/// Returns the ring of the edge between vertices c and d, both of the cell.
EdgeRing ring_around(const SpatialTriangulation& triangulation, CellId cell, std::int32_t c, std::int32_t d);

/// Whether a flip may add a vertex on each side of the kept ones, where there are no positive cells without it.
enum class NewVertices { none, allowed };

/// Replaces all cells of a ring by others without its edge, one of which has the edges between the `kept` vertices of
/// the ring: none, two, or three, which are a face then. The others are chosen so that the worst of them is best.
/// Returns false, and nothing has changed, if that is not possible with positive cells, would remove a constrained
/// face, or make something that crosses the goal.
bool remove_ring_edge(SpatialTriangulation& triangulation, const EdgeRing& ring, std::span<const std::int32_t> kept,
                      const Goal& goal = {}, NewVertices new_vertices = NewVertices::none);

/// Replaces those cells of a ring that are between vertices a and b, on either side, by others and by one with corners
/// a, b and the edge of the ring, which stays. Returns false, and nothing has changed, as remove_ring_edge() does.
bool span_ring(SpatialTriangulation& triangulation, const EdgeRing& ring, std::int32_t a, std::int32_t b,
               const Goal& goal = {}, NewVertices new_vertices = NewVertices::none);

/// Replaces two cells with a common face by three around the edge between the other two vertices. Returns false, and
/// nothing has changed, if one of them would not be positive, the face is constrained, or something new would cross the
/// goal.
bool replace_face_by_edge(SpatialTriangulation& triangulation, CellFace face, const Goal& goal = {});

}  // namespace kerf
