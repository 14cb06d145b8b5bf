// kerf._kerf.Mesh holds MeshArrays, and its properties are views that keep it alive; kerf/mesh.py adds everything that
// needs no C++. Long calls release the interpreter's lock and ask a Watch, which takes it back for a moment. A pickle
// is a dict of arrays by names, so that it does not depend on the version of Kerf, and names are bytes in it, since
// they may be no UTF-8.
#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/pickling.h"
#include "python/sizes.h"
#include "python/surface_object.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

std::shared_ptr<MeshArrays> mesh(const SurfaceObject& surface, const py::object& sizes, const py::object& progress,
                                 const std::string& programs, const py::kwargs& options) {
    Watch watch(progress);
    const MeshOptions wanted = mesh_options(sizes, programs, options, watch);
    return without_lock(watch, [&] { return std::make_shared<MeshArrays>(mesh_to_arrays(surface.surface, wanted)); });
}

// Meshes into a folder. `surface`: a Surface, or the path of a file.
void mesh_into(const py::object& surface, const std::string& folder, const py::object& sizes,
               const py::object& progress, const std::string& programs, const py::kwargs& options) {
    Watch watch(progress);
    const MeshOptions wanted = mesh_options(sizes, programs, options, watch);
    if (py::isinstance<SurfaceObject>(surface)) {
        const ClosedSurface& closed = surface.cast<SurfaceObject&>().surface;
        without_lock(watch, [&] { mesh_to_folder(closed, wanted, folder); });
    } else {
        const std::string path = py::str(surface);
        without_lock(watch, [&] { mesh_file_to_folder(path, wanted, folder); });
    }
}

// Returns a measure of a mesh, computed without the interpreter's lock.
template <class Measure>
auto measured(const MeshArrays& mesh, Measure measure) {
    const py::gil_scoped_release released;
    return measure(mesh);
}

py::list as_bytes(const std::vector<std::string>& names) {
    py::list list;
    for (const std::string& name : names) list.append(py::bytes(name));
    return list;
}

// Returns the state of a pickle: arrays by names, which numpy knows in any version.
py::dict state_of(const py::object& self) {
    using namespace py::literals;
    const MeshArrays& mesh = self.cast<MeshArrays&>();
    return py::dict("points"_a = view(mesh.vertices, self), "tetrahedra"_a = view(mesh.tets, self),
                    "part"_a = view(mesh.part, self), "region"_a = view(mesh.region, self),
                    "triangles"_a = view(mesh.triangles, self), "patch"_a = view(mesh.patch, self),
                    "sides"_a = view(mesh.sides, self), "tetra10"_a = view(mesh.quadratic_tets, self),
                    "triangle6"_a = view(mesh.quadratic_triangles, self), "edge_nodes"_a = mesh.edge_nodes,
                    "patch_names"_a = as_bytes(mesh.patch_names), "region_names"_a = as_bytes(mesh.region_names),
                    "report"_a = py::bytes(mesh.report));
}

std::shared_ptr<MeshArrays> mesh_of_state(const py::dict& state) {
    const auto names = [&](const char* name) { return state[name].cast<std::vector<std::string>>(); };
    return std::make_shared<MeshArrays>(
        MeshArrays{.vertices = rows_of_state<double, 3>(state, "points"),
                   .tets = rows_of_state<std::int64_t, 4>(state, "tetrahedra"),
                   .part = numbers_of_state<std::int32_t>(state, "part"),
                   .triangles = rows_of_state<std::int64_t, 3>(state, "triangles"),
                   .patch = numbers_of_state<std::int32_t>(state, "patch"),
                   .patch_names = names("patch_names"),
                   .region = numbers_of_state<std::int32_t>(state, "region"),
                   .region_names = names("region_names"),
                   .sides = rows_of_state<std::int32_t, 2>(state, "sides"),
                   .report = state["report"].cast<std::string>(),
                   .edge_nodes = state["edge_nodes"].cast<std::int64_t>(),
                   .quadratic_tets = rows_of_state<std::int64_t, 10>(state, "tetra10"),
                   .quadratic_triangles = rows_of_state<std::int64_t, 6>(state, "triangle6")});
}

}  // namespace

void register_mesh(py::module_& module) {
    py::class_<MeshArrays, std::shared_ptr<MeshArrays>>(module, "Mesh")
        .def(py::pickle(&state_of, &mesh_of_state))
        .def_property_readonly("points", array_of(&MeshArrays::vertices))
        .def_property_readonly("tetrahedra", array_of(&MeshArrays::tets))
        .def_property_readonly("order", [](const MeshArrays& self) { return self.quadratic_tets.empty() ? 1 : 2; })
        .def_property_readonly("tetra10", array_of(&MeshArrays::quadratic_tets))
        .def_property_readonly("triangle6", array_of(&MeshArrays::quadratic_triangles))
        .def_property_readonly("part", array_of(&MeshArrays::part))
        .def_property_readonly("region", array_of(&MeshArrays::region))
        .def_property_readonly("triangles", array_of(&MeshArrays::triangles))
        .def_property_readonly("patch", array_of(&MeshArrays::patch))
        .def_property_readonly("sides", array_of(&MeshArrays::sides))
        .def_property_readonly("report", [](const MeshArrays& self) { return self.report; })
        .def("neighbours",
             [](const MeshArrays& self) {
                 return owned(measured(self, [](const auto& mesh) { return neighbours_of(mesh); }));
             })
        .def("cell_quality",
             [](const MeshArrays& self, const std::string& measure) {
                 return owned(measured(self, [&](const auto& mesh) { return cell_quality(mesh, measure); }));
             })
        .def("quality",
             [](const MeshArrays& self) {
                 const QualityTexts texts = measured(self, [](const auto& mesh) { return quality_texts(mesh); });
                 return py::make_tuple(texts.json, texts.text);
             })
        .def_property_readonly("patch_names", [](const MeshArrays& self) { return self.patch_names; })
        .def_property_readonly("region_names", [](const MeshArrays& self) { return self.region_names; })
        .def(
            "save",
            [](const MeshArrays& self, const std::string& path, const std::string& msh_version, bool msh_ascii) {
                Watch watch{py::none()};
                const MeshFileOptions options{msh_version, msh_ascii, watch.is_cancelled()};
                without_lock(watch, [&] { mesh_to_file(self, path, options); });
            },
            py::arg("path"), py::arg("msh_version"), py::arg("msh_ascii"));
    module.def("mesh", &mesh, py::arg("of"), py::arg("sizes"), py::arg("progress"), py::arg("programs"));
    module.def("mesh_into", &mesh_into, py::arg("of"), py::arg("folder"), py::arg("sizes"), py::arg("progress"),
               py::arg("programs"));
    module.def("mesh_of_run", [](const std::string& folder) {
        const py::gil_scoped_release released;
        return std::make_shared<MeshArrays>(arrays_of_run(folder));
    });
}

}  // namespace kerf::python
