// Where the vertices of a contour lie in the plane in which its section is triangulated.
#pragma once

#include <array>
#include <vector>

#include "cut/cut.h"

namespace kerf {

/// How the contour lies in the plane while the section is triangulated.
enum class ContourLayout {
    projected,  ///< where its vertices project to
    unfolded,   ///< the same, but smoothed where it runs back on itself or along the normal of the plane
};

/// The loops of a contour in the plane, one after the other.
struct ContourInPlane {
    std::vector<Vec2> points;                        ///< #C
    std::vector<std::array<std::int32_t, 2>> edges;  ///< #C; the section on their left: they run against the loops
    std::vector<std::int32_t> previous, next;        ///< #C, along the loop
};

ContourInPlane project_contour(const Surface& surface, const Plane& plane,
                               const std::vector<std::vector<std::int32_t>>& loops);

/// Smooths the contour where its projection is spiked, has lost most of the length of an edge, or has a corner which,
/// cut off, would leave less than `good_dihedral_deg` between interface and surface. `vertices` (#C) are those of the
/// surface. False if there is no such place. Bounded passes; O(#C) each.
bool unfold(const Surface& surface, const std::vector<std::int32_t>& vertices, double good_dihedral_deg,
            ContourInPlane& contour);

/// Edge lengths for the interior at each vertex of an unfolded contour: 0.8 of the mean length in space of its two
/// edges, because that is how long they are when the points inside have been lifted.
std::vector<double> sizes_in_space(const Surface& surface, const std::vector<std::int32_t>& vertices,
                                   const ContourInPlane& contour);

}  // namespace kerf
