// Contacts of two facets that lie in one plane. All signs but those with a tolerance are exact.
#pragma once

#include <array>

#include "base/core/types.h"

namespace kerf {

using Corners = std::array<Vec3, 3>;

/// Returns the orientation of a triangle in the projection along a coordinate axis: 1 if it is counter-clockwise seen
/// against the axis, -1 if clockwise, 0 without area.
int projected_orientation(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

/// Returns the coordinate axis along which a facet is projected with the most area, -1 for a facet without area.
int axis_across(const Corners& facet);

/// Whether a point in the plane of a facet lies in it or on its border. `axis`: of axis_across().
bool has_point(const Corners& facet, int axis, const Vec3& p);

/// Whether all corners of one facet are within `tolerance` of the plane of the other, or on it where the tolerance is
/// 0, and the two planes are not steep to each other.
bool lie_in_one_plane(const Corners& p, const Corners& q, double tolerance);

/// Whether two facets of one plane overlap in more than a line. `axis`: of axis_across().
bool share_area(const Corners& p, const Corners& q, int axis);

}  // namespace kerf
