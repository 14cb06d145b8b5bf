#include "python/surface_arrays.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/core/error.h"
#include "python/arrays.h"

namespace kerf::python {

namespace {

// `names`: a list of bytes as kerf/paths.py encodes it, or None.
std::vector<std::string> names_of(const py::object& names) {
    return names.is_none() ? std::vector<std::string>() : names.cast<std::vector<std::string>>();
}

void check_length(const char* name, std::size_t rows, std::size_t triangles) {
    if (rows != triangles)
        throw Error(ErrorCode::usage, fmt::format("{} has {} rows, but there are {} triangles: one is wanted for each.",
                                                  name, rows, triangles));
}

}  // namespace

SurfaceArguments surface_arguments(const py::object& points, const py::object& triangles, const py::object& patches,
                                   const py::object& names, const py::object& sides, const py::object& regions) {
    SurfaceArguments all;
    all.points = points_of(points, "points");
    all.triangles = triangles_of(triangles, "triangles");
    if (!patches.is_none()) {
        all.patches = numbers_of(patches, "patches");
        check_length("patches", all.patches.size(), all.triangles.size());
    }
    if (sides.is_none() != regions.is_none())
        throw Error(ErrorCode::usage, "sides and regions belong together: give both, or none of them.");
    if (!sides.is_none()) {
        all.sides = pairs_of(sides, "sides");
        check_length("sides", all.sides.size(), all.triangles.size());
    }
    all.names = names_of(names);
    all.regions = names_of(regions);
    return all;
}

}  // namespace kerf::python
