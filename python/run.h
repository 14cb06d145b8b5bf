// kerf.Run.
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

void register_run(pybind11::module_& module);

}  // namespace kerf::python
