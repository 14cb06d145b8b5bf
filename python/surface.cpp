// kerf._kerf.Surface holds a ClosedSurface with its arrays (python/surface_object.h); kerf/surface.py adds everything
// that needs no C++. Long calls release the interpreter's lock and ask a Watch. Names go through decoded(), because
// they may be no UTF-8. A matrix of axes has them as columns in the kernel and as rows in Python: its memory is handed
// over as it is.
#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/surface_arrays.h"
#include "python/surface_object.h"
#include "python/text.h"
#include "run/prepare/input.h"
#include "run/report/repair_json.h"
#include "surface/complex/solid_properties.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

std::shared_ptr<SurfaceObject> made(ClosedSurface surface) {
    return std::make_shared<SurfaceObject>(SurfaceObject{std::move(surface)});
}

std::shared_ptr<SurfaceObject> make_surface(const py::object& points, const py::object& triangles,
                                            const py::object& patches, const py::object& names, const py::object& sides,
                                            const py::object& regions, const py::kwargs& options) {
    const SurfaceArguments all = surface_arguments(points, triangles, patches, names, sides, regions);
    const NamedOptions named = named_options(options);
    Watch watch{py::none()};
    return without_lock(watch, [&] {
        return made(surface_of_regions(all.points, all.triangles, all.sides, all.regions, all.patches, all.names, named,
                                       watch.is_cancelled()));
    });
}

std::shared_ptr<SurfaceObject> read(const std::string& path, const py::kwargs& options) {
    const NamedOptions named = named_options(options);
    Watch watch{py::none()};
    return without_lock(watch, [&] { return made(surface_from_file(path, named, watch.is_cancelled())); });
}

std::shared_ptr<SurfaceObject> remesh(const SurfaceObject& self, const py::object& progress,
                                      const py::kwargs& options) {
    Watch watch(progress);
    const NamedOptions named = named_options(options);
    return without_lock(watch,
                        [&] { return made(remeshed(self.surface, named, watch.progress(), watch.is_cancelled())); });
}

void save(const SurfaceObject& self, const std::string& path) {
    const py::gil_scoped_release released;
    surface_to_file(self.surface, path);
}

py::object wrapped(const SurfaceObject& self) {
    using namespace py::literals;
    const std::optional<WrapReport>& report = self.surface.input().wrapped;
    if (!report) return py::none();
    return py::dict("gap"_a = report->gap, "offset"_a = report->offset, "facets_before"_a = report->facets_before,
                    "facets_left_out"_a = report->left_out, "facets_visible"_a = report->seen,
                    "facets"_a = report->facets, "distance_to_input"_a = report->distance_to_input,
                    "distance_from_visible_input"_a = report->distance_from_input);
}

SolidProperties solid_of(const SurfaceObject& self) { return solid_properties(self.surface.input().complex); }

py::array array_of(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }
// Returns the columns as rows: a column of Eigen's matrix is in one piece of memory, and so is a row of numpy's.
py::array array_of(const Eigen::Matrix3d& columns) { return py::array_t<double>({3, 3}, columns.data()); }

}  // namespace

void register_surface(py::module_& module) {
    py::class_<SurfaceObject, std::shared_ptr<SurfaceObject>>(module, "Surface")
        .def(py::init(&make_surface), py::arg("points"), py::arg("triangles"), py::arg("patches") = py::none(),
             py::arg("names") = py::none(), py::arg("sides") = py::none(), py::arg("regions") = py::none())
        .def_property_readonly("points",
                               [](const py::object& self) { return view(self.cast<SurfaceObject&>().points, self); })
        .def_property_readonly("triangles",
                               [](const py::object& self) { return view(self.cast<SurfaceObject&>().triangles, self); })
        .def_property_readonly("patches",
                               [](const py::object& self) { return view(self.cast<SurfaceObject&>().patches, self); })
        .def_property_readonly("sides",
                               [](const py::object& self) { return view(self.cast<SurfaceObject&>().sides, self); })
        .def_property_readonly("names", [](const SurfaceObject& self) { return decoded(self.surface.patch_names()); })
        .def_property_readonly("regions",
                               [](const SurfaceObject& self) { return decoded(self.surface.region_names()); })
        .def_property_readonly("volume", [](const SurfaceObject& self) { return self.surface.volume(); })
        .def_property_readonly("area", [](const SurfaceObject& self) { return self.surface.area(); })
        .def_property_readonly("centroid", [](const SurfaceObject& self) { return array_of(solid_of(self).centroid); })
        .def_property_readonly("inertia", [](const SurfaceObject& self) { return array_of(solid_of(self).inertia); })
        .def_property_readonly("principal_moments",
                               [](const SurfaceObject& self) { return array_of(solid_of(self).principal.moments); })
        .def_property_readonly("principal_axes",
                               [](const SurfaceObject& self) { return array_of(solid_of(self).principal.axes); })
        .def_property_readonly("repairs",
                               [](const SurfaceObject& self) { return decoded(to_json(self.surface.input().ladder)); })
        .def_property_readonly("wrapped", &wrapped)
        .def("remesh", &remesh, py::arg("progress"))
        .def("save", &save, py::arg("path"));
    module.def("read", &read, py::arg("path"));
}

}  // namespace kerf::python
