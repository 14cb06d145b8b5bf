// Heights at which an interface leaves the surface at a good angle.
#pragma once

#include <vector>

#include "cut/band.h"
#include "cut/lift.h"

namespace kerf {

/// For every point of the triangulation of a section the range of heights in which its triangles at the contour form
/// at least `angle_deg` with the surface on either side; unbounded for points off the contour's triangles. Where the
/// two sides enclose less than twice the angle, the range is the middle between them. `contour`: vertices of the
/// surface, the first points of `planar`. O(#triangles).
std::vector<HeightRange> dihedral_ranges(const Surface& surface, const Band& band, const std::vector<Side>& side,
                                         const std::vector<std::int32_t>& contour,
                                         const std::vector<Triangle>& triangles, const std::vector<Vec2>& places,
                                         double angle_deg);

}  // namespace kerf
