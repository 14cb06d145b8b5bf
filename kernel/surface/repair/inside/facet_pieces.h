// Facets that are divided where vertices lie on their sides.
#pragma once

#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// A vertex on the side of a facet, at which the facet is to be divided.
struct SidePoint {
    std::int32_t corner;  ///< 3 f + i: the side of facet f from its vertex i to the next one
    double along;         ///< grows from the first end of the side to the second; differs among points of a side
    std::int32_t vertex;
};

/// Returns the pieces of one facet, in the order in which they take its place. `chains`: per side the vertices on it,
/// from its first end on. All pieces have area if the facet has, and the vertices lie on its sides.
std::vector<Triangle> pieces_of(const Triangle& facet, const std::array<std::vector<std::int32_t>, 3>& chains);

/// Divides each facet at its points, given in any order. The pieces follow each other in its place, and have its patch
/// and its number in the file; other facets stay as they are. Returns the former number of each facet or of the one
/// that it is a piece of, or nothing without points. The soup must have no sides of regions. O(#F + n log n).
std::vector<std::int32_t> divide_at(Soup& soup, std::vector<SidePoint> points);

/// Fills Soup::vertex_number with the places of the vertices, if it is empty.
void number_vertices(Soup& soup);

/// Fills Soup::polygon with the places of the facets, if it is empty.
void number_facets(Soup& soup);

}  // namespace kerf
