// The module kerf._kerf: the facade (kerf/kerf.h) with arrays of numpy.
#include "python/bindings.h"

#include "files/io/program_finder.h"
#include "kerf/kerf.h"

PYBIND11_MODULE(_kerf, module) {
    module.attr("__version__") = kerf::library_version();
    module.def("find_program", &kerf::find_kerf_program, pybind11::arg("name"), pybind11::arg("first_folder") = "");
    kerf::python::register_errors(module);
    kerf::python::register_options(module);
    kerf::python::register_check(module);
    kerf::python::register_surface(module);
    kerf::python::register_sizes(module);
    kerf::python::register_mesh(module);
    kerf::python::register_part(module);
    kerf::python::register_run(module);
    kerf::python::register_distributed(module);
    kerf::python::register_tree(module);
    kerf::python::register_plotting(module);
}
