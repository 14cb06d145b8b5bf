// The facets of a box.
#pragma once

#include <array>
#include <string>

#include "base/geometry/box.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Returns a box with facets whose edges have about this length in the mean, as a closed surface with normals that
/// point out. Each face is a patch: that at the low end of x first, then that at its high end, and so on. The faces lie
/// exactly at the coordinates of the box. Vertices are shared. O(#F).
Soup facets_of_box(const Box& box, double edge, const std::array<std::array<std::string, 2>, 3>& face_names);

}  // namespace kerf
