// kerf.Mesh and kerf.mesh().
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

void register_mesh(pybind11::module_& module);

}  // namespace kerf::python
