// The value of a kerf.Surface.
#pragma once

#include <array>
#include <vector>

#include "kerf/kerf.h"
#include "python/values.h"

namespace kerf::python {

/// A surface with its arrays, which are made once; arrays of numpy share their memory.
struct SurfaceObject {
    ClosedSurface surface;
    std::vector<std::array<double, 3>> points = surface.vertices();
    std::vector<std::array<std::int32_t, 3>> triangles = surface.facets();
    std::vector<std::int32_t> patches = surface.patches();
    std::vector<std::array<std::int32_t, 2>> sides = surface.sides();
};

}  // namespace kerf::python
