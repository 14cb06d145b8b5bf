// Defects of surfaces as objects of Python.
#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "kerf/kerf.h"

namespace kerf::python {

/// Returns a kerf.Defect for each.
pybind11::list defects_of(const std::vector<SurfaceDefect>& defects);

}  // namespace kerf::python
