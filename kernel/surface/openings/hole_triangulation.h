// Triangles over a closed rim that need not be planar.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Returns triangles over positions in a closed rim, in its direction, or none if there is no triangulation. Of all
/// triangulations of the rim's vertices it is that whose largest angle between neighbours is smallest, and of these
/// that of the least area (Liepa 2003, liepa2003), by CGAL. `apexes`: the third corner of the facet at each edge of the
/// rim, so that the angles at the rim count, too; if empty, they do not. O(n^3) at worst. Deterministic.
std::vector<Triangle> triangulate_hole(const std::vector<Vec3>& rim, const std::vector<Vec3>& apexes);

}  // namespace kerf
