// Vertices of borders that go onto edges of other facets.
#pragma once

#include <vector>

#include "surface/repair/inside/border.h"
#include "surface/repair/inside/facet_pieces.h"

namespace kerf {

/// Finds vertices of the border nearer than `tolerance` to an open edge of another facet, of several edges the nearest.
/// Returns where that facet is to be divided so that its edge goes through them: `along` counts in shares of the edge.
/// No vertex moves. Only points that join borders are returned: of the pieces that an edge has at a vertex at least one
/// is an edge of another facet, or of a piece of one, and none is an edge of three. Left out are ends of the edge;
/// points in the fifth of the edge next to an end whose vertex is nearer than `near_end` to that end (it should rather
/// become one with it); points that are near along the border for their distance (the sides of a hole); and points that
/// would turn a piece over. Deterministic. O(n log n) for n open edges, while few are within the tolerance of a vertex.
std::vector<SidePoint> find_border_points(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                          const Border& border, double tolerance, double near_end);

}  // namespace kerf
