// A lifted interface whose angles are too small in space, though they were not in the plane.
#pragma once

#include "cut/options.h"

namespace kerf {

/// Moves interior points towards the middle of their neighbours wherever the worst measure around them grows: angles of
/// triangles, and dihedral angles at the contour, each over its threshold in `options`. Points around which all are
/// good stay. Whether the interface still is free of the surface has to be judged again. Deterministic; O(#T) a sweep,
/// bounded sweeps.
void smooth_interface(const Surface& surface, const CutOptions& options, Interface& interface);

}  // namespace kerf
