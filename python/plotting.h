// The files that kerf.plot() writes for kerf-view.
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

void register_plotting(pybind11::module_& module);

}  // namespace kerf::python
