// A point inside of a closed surface.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Returns a point inside of a closed surface, whose facets are turned outwards: of the middles of rays
/// that go inwards from its largest facets, that with the longest ray. Not exact: in a body whose thickness is near the
/// spacing of its coordinates the point may lie on a facet. Requires a facet with an area. Deterministic. O(#F log #F).
Vec3 point_inside(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
