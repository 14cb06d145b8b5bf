// Defects of surfaces as objects of Python.
#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "kerf/kerf.h"

namespace kerf::python {

/// Returns a kerf.Defect for each.
pybind11::list defects_of(const std::vector<SurfaceDefect>& defects);

/// Registers kerf._kerf.Check and the functions that return one.
void register_check(pybind11::module_& module);

}  // namespace kerf::python
