// The arrays of which a surface is made.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace kerf::python {

/// The arguments of a surface as the facade takes them; `sides` and `regions` are both empty or both not.
struct SurfaceArguments {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::int32_t> patches;
    std::vector<std::string> names;
    std::vector<std::array<std::int32_t, 2>> sides;
    std::vector<std::string> regions;
};

/// Copies the arguments of kerf.Surface; all but the first two may be None. Throws UsageError, naming the
/// argument, for dtypes, shapes and lengths that do not fit.
SurfaceArguments surface_arguments(const pybind11::object& points, const pybind11::object& triangles,
                                   const pybind11::object& patches, const pybind11::object& names,
                                   const pybind11::object& sides, const pybind11::object& regions);

}  // namespace kerf::python
