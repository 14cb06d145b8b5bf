// Meshes on ranks: the functions that kerf/distributed.py calls.
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

void register_distributed(pybind11::module_& module);

}  // namespace kerf::python
