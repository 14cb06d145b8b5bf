// The heights of an interface over its plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cut/cut/planar_triangulation.h"

namespace kerf {

/// A surface vertex that the interface must pass on one side.
struct Obstacle {
    Vec2 position = Vec2::Zero();
    double height = 0;
    double size = 0;          ///< local edge length of the surface
    Side side = Side::below;  ///< the half of the vertex: the interface passes above a vertex of the half below
    double clearance = 0;     ///< wanted distance of the interface, in units of `size`
};

/// The range of a point's height; if it is empty (low > high), the height is its middle.
struct HeightRange {
    double low = -INFINITY, high = INFINITY;
    double clamp(double z) const { return low > high ? (low + high) / 2 : std::clamp(z, low, high); }
};

/// Returns the harmonic extension of the displacements of the contour (#C) to all points; weights as in lift_heights().
std::vector<Vec2> harmonic_displacements(const PlanarTriangulation& triangulation, const std::vector<Vec2>& of_contour,
                                         const CancellationCheck& check_cancelled = {});

/// Returns harmonic heights, one per point, with the contour's heights as boundary values. They are then bounded by
/// `ranges` (one per point, or none) and by the obstacles, whose bound falls off with the distance at rate 0.3. Weights
/// are cotangents, but positive where triangles are obtuse, so that no height lies beyond those of the contour;
/// constants are reproduced exactly, and planes except for that. `places` (#P) are the positions of the points, which
/// may differ from those at which they were triangulated; `contour_height`: #C. O(n^1.5) for the factorisation.
std::vector<double> lift_heights(const PlanarTriangulation& triangulation, const std::vector<Vec2>& places,
                                 const std::vector<double>& contour_height, const std::vector<Obstacle>& obstacles,
                                 std::vector<HeightRange> ranges = {}, const CancellationCheck& check_cancelled = {});

}  // namespace kerf
