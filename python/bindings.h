// The registers of the module kerf._kerf: one for each source with classes and functions of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace kerf::python {

void register_check(pybind11::module_& module);        // kerf.check()
void register_distributed(pybind11::module_& module);  // meshes on ranks
void register_errors(pybind11::module_& module);       // makes kerf::Error the class of kerf/errors.py for its code
void register_mesh(pybind11::module_& module);
void register_options(pybind11::module_& module);   // the table of options, and the nearest name to a wrong one
void register_part(pybind11::module_& module);      // parts of runs
void register_plotting(pybind11::module_& module);  // the files that kerf.plot() writes for kerf-view
void register_run(pybind11::module_& module);       // runs in folders, and commands on them
void register_sizes(pybind11::module_& module);
void register_surface(pybind11::module_& module);
void register_tree(pybind11::module_& module);  // trees of cuts

}  // namespace kerf::python
