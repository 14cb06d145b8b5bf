// kerf.Tree and kerf.decompose().
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

void register_tree(pybind11::module_& module);

}  // namespace kerf::python
