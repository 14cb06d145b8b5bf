// The positions of the contour's vertices in the plane in which its section is triangulated.
#pragma once

#include <array>
#include <vector>

#include "cut/cut/cut.h"

namespace kerf {

/// The layout of a contour in the plane while its section is triangulated.
enum class ContourLayout {
    projected,  ///< the projections of its vertices
    unfolded,   ///< smoothed where the projection runs back on itself or along the normal of the plane
};

/// The loops of a contour in the plane, one after the other.
struct ContourInPlane {
    std::vector<Vec2> points;                        ///< #C
    std::vector<std::array<std::int32_t, 2>> edges;  ///< #C; the section is on their left: they run against the loops
    std::vector<std::int32_t> previous, next;        ///< #C, along the loop
};

ContourInPlane project_contour(const Surface& surface, const Plane& plane,
                               const std::vector<std::vector<Vertex>>& loops);

/// Smooths the contour where its projection is spiked, has lost most of the length of an edge, or has a corner that, if
/// it were cut off, would leave less than `good_dihedral_deg` between interface and surface. `vertices` (#C) are the
/// contour's vertices in the surface. Returns false if there is no such place. Bounded passes; O(#C) each.
bool unfold(const Surface& surface, const std::vector<Vertex>& vertices, double good_dihedral_deg,
            ContourInPlane& contour);

/// Returns the edge lengths for the interior at each vertex of an unfolded contour: 0.8 of the mean length in space of
/// its two edges, because edges between inner points get about that long by lifting.
std::vector<double> sizes_in_space(const Surface& surface, const std::vector<Vertex>& vertices,
                                   const ContourInPlane& contour);

}  // namespace kerf
