// The smoothing of a lifted interface whose angles are good in the plane but too small in space.
#pragma once

#include "cut/cut/inside/options.h"

namespace kerf {

/// Moves interior points towards the middle of their neighbours wherever that improves the worst measure around them:
/// the angles of triangles and the dihedral angles at the contour, each over its threshold in `options`. Points around
/// which all measures are good stay. The result may intersect the surface and has to be judged again. Deterministic;
/// O(#T) a sweep, bounded sweeps.
void smooth_interface(const Surface& surface, const CutOptions& options, Interface& interface);

}  // namespace kerf
