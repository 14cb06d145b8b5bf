#include "kerf/viewed_files.h"
#include "python/bindings.h"
#include "python/surface_object.h"

namespace kerf::python {

namespace py = pybind11;

void register_plotting(py::module_& module) {
    module.def(
        "write_surface_to_view",
        [](const SurfaceObject& surface, const std::string& path) { write_surface_to_view(surface.surface, path); },
        py::arg("surface"), py::arg("path"), py::call_guard<py::gil_scoped_release>());
    module.def("write_mesh_to_view", &write_mesh_to_view, py::arg("mesh"), py::arg("folder"),
               py::call_guard<py::gil_scoped_release>());
}

}  // namespace kerf::python
