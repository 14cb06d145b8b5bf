// The smallest surface that still shows what a large one has shown.
#pragma once

#include <functional>

#include "surface/complex/surface.h"

namespace kerf::bench {

/// Leaves out shells, collapses edges, and rounds coordinates, as long as the surface stays one without defects
/// (surface/diagnosis/diagnosis.h), without lower needles than it has, and `is_wanted`. Requires that the surface
/// itself is wanted. Tries each shell and each edge until none can be left out. Deterministic.
SurfaceArrays reduced(const SurfaceArrays& surface, const std::function<bool(const SurfaceArrays&)>& is_wanted);

}  // namespace kerf::bench
