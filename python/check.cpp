#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/defects.h"
#include "python/options.h"
#include "python/surface_arrays.h"
#include "python/text.h"
#include "python/values.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

py::array_t<double> rows_of(const std::vector<std::array<double, 3>>& points) {
    py::array_t<double> rows({std::ssize(points), py::ssize_t{3}});
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) rows.mutable_at(i, k) = points[i][k];
    return rows;
}

py::array numbers_of(const std::vector<std::int64_t>& numbers) {
    return py::array_t<std::int64_t>(std::ssize(numbers), numbers.data());
}

py::object defect_of(const py::object& type, const SurfaceDefect& defect) {
    using namespace py::literals;
    return type("kind"_a = defect.kind, "severity"_a = defect.severity, "facets"_a = numbers_of(defect.facets),
                "vertices"_a = numbers_of(defect.vertices), "points"_a = rows_of(defect.points),
                "measure"_a = defect.measure, "regions"_a = decoded(defect.regions), "advice"_a = defect.advice,
                "text"_a = decoded(defect.text));
}

SurfaceCheck check_path(const std::string& path, double needle_angle, const py::kwargs& options) {
    const NamedOptions named = named_options(options);
    Watch watch{py::none()};
    return without_lock(watch, [&] { return kerf::check_file(path, named, needle_angle, watch.is_cancelled()); });
}

SurfaceCheck check_given(const py::object& points, const py::object& triangles, const py::object& patches,
                         const py::object& names, const py::object& sides, const py::object& regions,
                         double needle_angle, const py::kwargs& options) {
    const SurfaceArguments all = surface_arguments(points, triangles, patches, names, sides, regions);
    const NamedOptions named = named_options(options);
    Watch watch{py::none()};
    return without_lock(watch, [&] {
        return kerf::check_arrays(all.points, all.triangles, all.sides, all.regions, all.patches, all.names, named,
                                  needle_angle, watch.is_cancelled());
    });
}

}  // namespace

py::list defects_of(const std::vector<SurfaceDefect>& defects) {
    const py::object type = py::module_::import("kerf.defect").attr("Defect");
    py::list list;
    for (const SurfaceDefect& defect : defects) list.append(defect_of(type, defect));
    return list;
}

void register_check(py::module_& module) {
    py::class_<SurfaceCheck, std::shared_ptr<SurfaceCheck>>(module, "Check")
        .def(sharing<SurfaceCheck>(), py::arg("other"))
        .def_readonly("ok", &SurfaceCheck::can_be_meshed,
                      "Whether the surface can be meshed, after repairs that do not change its geometry.")
        .def_property_readonly("_text", [](const SurfaceCheck& self) { return decoded(self.text); })
        .def_property_readonly("_json", [](const SurfaceCheck& self) { return decoded(self.json); })
        .def_property_readonly("_defects", [](const SurfaceCheck& self) { return defects_of(self.defects); });
    module.def("check_path", &check_path, py::arg("path"), py::arg("needle_angle"));
    module.def("check_arrays", &check_given, py::arg("points"), py::arg("triangles"), py::arg("patches"),
               py::arg("names"), py::arg("sides"), py::arg("regions"), py::arg("needle_angle"));
}

}  // namespace kerf::python
