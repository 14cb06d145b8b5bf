#include "python/surface.h"

#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/options.h"
#include "python/surface_object.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

std::vector<std::string> names_of(const py::object& names) {
    return names.is_none() ? std::vector<std::string>() : names.cast<std::vector<std::string>>();
}

std::shared_ptr<SurfaceObject> make_surface(const py::object& points, const py::object& triangles,
                                            const py::object& patches, const py::object& names, const py::object& sides,
                                            const py::object& regions, const py::kwargs& options) {
    const auto vertices = points_of(points, "points");
    const auto facets = triangles_of(triangles, "triangles");
    const auto of_facets = patches.is_none() ? std::vector<std::int32_t>() : numbers_of(patches, "patches");
    const NamedOptions named = named_options(options);
    if (sides.is_none() != regions.is_none())
        throw py::value_error("sides and regions belong together: give both, or none of them.");
    if (sides.is_none()) {
        const auto patch_names = names_of(names);
        const py::gil_scoped_release released;
        return std::make_shared<SurfaceObject>(
            SurfaceObject{surface_from_arrays(vertices, facets, of_facets, patch_names, named)});
    }
    const auto of_sides = pairs_of(sides, "sides");
    const auto patch_names = names_of(names), region_names = names_of(regions);
    const py::gil_scoped_release released;
    return std::make_shared<SurfaceObject>(
        SurfaceObject{surface_of_regions(vertices, facets, of_sides, region_names, of_facets, patch_names, named)});
}

std::shared_ptr<SurfaceObject> read(const py::object& path, const py::kwargs& options) {
    const std::string name = py::str(py::module_::import("os").attr("fspath")(path));
    const NamedOptions named = named_options(options);
    const py::gil_scoped_release released;
    return std::make_shared<SurfaceObject>(SurfaceObject{surface_from_file(name, named)});
}

}  // namespace

void register_surface(py::module_& module) {
    py::class_<SurfaceObject, std::shared_ptr<SurfaceObject>>(module, "Surface")
        .def(py::init(&make_surface), py::arg("points"), py::arg("triangles"), py::arg("patches") = py::none(),
             py::arg("names") = py::none(), py::arg("sides") = py::none(), py::arg("regions") = py::none())
        .def_property_readonly("points", [](py::object self) { return view(self.cast<SurfaceObject&>().points, self); })
        .def_property_readonly("triangles",
                               [](py::object self) { return view(self.cast<SurfaceObject&>().triangles, self); })
        .def_property_readonly("patches",
                               [](py::object self) { return view(self.cast<SurfaceObject&>().patches, self); })
        .def_property_readonly("sides", [](py::object self) { return view(self.cast<SurfaceObject&>().sides, self); })
        .def_property_readonly("names", [](const SurfaceObject& self) { return self.surface.patch_names(); })
        .def_property_readonly("regions", [](const SurfaceObject& self) { return self.surface.region_names(); })
        .def_property_readonly("volume", [](const SurfaceObject& self) { return self.surface.volume(); })
        .def_property_readonly("area", [](const SurfaceObject& self) { return self.surface.area(); })
        .def(
            "remesh",
            [](const SurfaceObject& self, double size, double deviation, const py::object& progress) {
                Watch watch(progress);
                return std::make_shared<SurfaceObject>(SurfaceObject{without_lock(watch, [&] {
                    return remeshed(self.surface, deviation, size, watch.progress(), watch.is_cancelled());
                })});
            },
            py::arg("size") = 0., py::arg("deviation") = 0., py::arg("progress") = py::none());
    module.def("read", &read, py::arg("path"));
}

}  // namespace kerf::python
