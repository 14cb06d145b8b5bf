// Errors of Kerf as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

/// kerf::Error is the class of kerf/errors.py that its code has, with `.code` and `.elements`.
void register_errors(pybind11::module_& module);

}  // namespace kerf::python
