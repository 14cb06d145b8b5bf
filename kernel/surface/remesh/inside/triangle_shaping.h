// The order in which the remesher uses its operations.
#pragma once

#include "surface/remesh/inside/bounded_surface.h"
#include "surface/remesh/remesh.h"

namespace kerf {

/// Leaves out all that the bound does not need, finds sizes (FoldSizes), then splits, moves, collapses and flips until
/// triangles are well shaped and of these sizes. Deterministic. O(n log n) for n facets before and after.
void shape_triangles(BoundedSurface& surface, const RemeshOptions& options);

}  // namespace kerf
