// Vertices of borders that go onto edges of others.
#pragma once

#include <vector>

#include "repair/border.h"
#include "repair/facet_pieces.h"

namespace kerf {

/// Vertices of the border nearer than `tolerance` to an open edge of another facet, the nearest of these, and where the
/// facet is to be divided, so that its edge goes through them: `along` counts in shares of the edge. No vertex moves.
/// Only what joins borders is returned: of the pieces that an edge has at a vertex at least one is an edge of another
/// facet, or of a piece of one, and none of three. Left alone are ends of edges and what is
/// nearer than `near_end` to one, in the first fifth of the edge (it should rather become one with it), what is near
/// along the border for its distance (the sides of a hole), and what would turn a piece over. Deterministic. O(n log n)
/// for n open edges, while few are within the tolerance of a vertex.
std::vector<SidePoint> find_border_points(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                          const Border& border, double tolerance, double near_end);

}  // namespace kerf
