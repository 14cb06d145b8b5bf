// The heights at which an interface leaves the surface at a good angle.
#pragma once

#include <vector>

#include "cut/cut/inside/band.h"
#include "cut/cut/inside/lift.h"

namespace kerf {

/// Returns for every point of a section's triangulation the range of heights in which its triangles at the contour form
/// at least `angle_deg` with the surface on either side; unbounded for points off these triangles. Where the two sides
/// enclose less than twice the angle, the range is the middle between them. `contour` are vertices of the surface, the
/// first of the points; `places` (#P) are the points in the plane. O(#triangles).
std::vector<HeightRange> dihedral_ranges(const Surface& surface, const Band& band, const std::vector<Side>& side,
                                         const std::vector<std::int32_t>& contour,
                                         const std::vector<Triangle>& triangles, const std::vector<Vec2>& places,
                                         double angle_deg);

}  // namespace kerf
