// kerf._kerf.Surface holds a ClosedSurface with its arrays (python/surface_object.h); kerf.Surface
// (kerf/surface.py) inherits its properties, and adds everything that needs no C++, by the members with an underscore.
// Long calls release the interpreter's lock and ask a Watch. Names go through decoded(), because they may be no UTF-8.
// A matrix of axes has them as columns in the kernel and as rows in Python: its memory is handed over as it is.
#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/surface_arrays.h"
#include "python/surface_object.h"
#include "python/text.h"
#include "python/values.h"
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

py::array copied(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }
// Returns the columns as rows: a column of Eigen's matrix is in one piece of memory, and so is a row of numpy's.
py::array copied(const Eigen::Matrix3d& columns) { return py::array_t<double>({3, 3}, columns.data()); }

using SurfaceClass = py::class_<SurfaceObject, std::shared_ptr<SurfaceObject>>;

void add_arrays_of_surface(SurfaceClass& type) {
    type.def_property_readonly("points", array_of(&SurfaceObject::points), "(n, 3) float64.")
        .def_property_readonly(
            "triangles", array_of(&SurfaceObject::triangles),
            "(m, 3) int32: corners, counter-clockwise seen from outside, or from in front of a wall.")
        .def_property_readonly("patches", array_of(&SurfaceObject::patches), "(m,) int32: rows of `names`.")
        .def_property_readonly(
            "names", [](const SurfaceObject& self) { return decoded(self.surface.patch_names()); }, "Of the patches.")
        .def_property_readonly("sides", array_of(&SurfaceObject::sides),
                               "(m, 2) int32: the regions behind and in front of each triangle, -1: outside.")
        .def_property_readonly(
            "regions", [](const SurfaceObject& self) { return decoded(self.surface.region_names()); },
            "Names; empty if there is one region.");
}

void add_measures_of_surface(SurfaceClass& type) {
    type.def_property_readonly(
            "volume", [](const SurfaceObject& self) { return self.surface.volume(); },
            "Enclosed, of all regions, in cubed units of the points.")
        .def_property_readonly(
            "area", [](const SurfaceObject& self) { return self.surface.area(); },
            "Each triangle once, in squared units of the points.")
        .def_property_readonly(
            "centroid", [](const SurfaceObject& self) { return copied(solid_of(self).centroid); },
            "(3,) float64: of the volume of all regions. O(m), as the inertia and the axes.")
        .def_property_readonly(
            "inertia", [](const SurfaceObject& self) { return copied(solid_of(self).inertia); },
            "(3, 3) float64: of the volume of all regions about the centroid, with a density of 1, so in units^5.")
        .def_property_readonly(
            "principal_axes", [](const SurfaceObject& self) { return copied(solid_of(self).principal.axes); },
            "(3, 3) float64: unit vectors as rows, in the order of `principal_moments`: the first is the long "
            "direction\n"
            "of the body. The largest component of each is positive; of equal moments they are the coordinate axes, "
            "if\n"
            "can be.")
        .def_property_readonly(
            "principal_moments", [](const SurfaceObject& self) { return copied(solid_of(self).principal.moments); },
            "(3,) float64: of the inertia, ascending.");
}

}  // namespace

void register_surface(py::module_& module) {
    SurfaceClass type(module, "Surface");
    type.def(sharing<SurfaceObject>(), py::arg("other"));
    add_arrays_of_surface(type);
    add_measures_of_surface(type);
    type.def_property_readonly("_repairs",
                               [](const SurfaceObject& self) { return decoded(to_json(self.surface.input().ladder)); })
        .def_property_readonly("_wrapped", &wrapped)
        .def_property_readonly("_notes", [](const SurfaceObject& self) { return decoded(self.surface.notes()); })
        .def("_remesh", &remesh, py::arg("progress"))
        .def("_save", &save, py::arg("path"));
    module.def("read", &read, py::arg("path"));
    module.def("surface_of_arrays", &make_surface, py::arg("points"), py::arg("triangles"), py::arg("patches"),
               py::arg("names"), py::arg("sides"), py::arg("regions"));
}

}  // namespace kerf::python
