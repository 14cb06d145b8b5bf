// Triangles over a closed rim that need not be planar.
#pragma once

#include <vector>

#include "core/types.h"

namespace kerf {

/// Triangles over positions in a closed rim, in its direction; empty if there are none. Of all triangulations of its
/// vertices the one whose largest angle between neighbours is the smallest, then that of the least area (Liepa 2003),
/// by CGAL. `apexes`: of the facet at each edge its third corner, with which the angles at the rim count, too; none if
/// empty. O(n^3) at worst. Deterministic.
std::vector<Triangle> triangulate_hole(const std::vector<Vec3>& rim, const std::vector<Vec3>& apexes);

}  // namespace kerf
