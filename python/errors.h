// Errors of Kerf as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

/// Makes kerf::Error the class of kerf/errors.py for its code, with `.code` and `.elements`.
void register_errors(pybind11::module_& module);

}  // namespace kerf::python
