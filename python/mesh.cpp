// kerf._kerf.Mesh holds MeshArrays, and its properties are views that keep it alive; kerf.Mesh (kerf/mesh.py) inherits
// them, and adds everything that needs no C++, by the members with an underscore. Long calls release the interpreter's
// lock and ask a Watch, which takes it back for a moment. A pickle is a dict of arrays by names, so that it does not
// depend on the version of Kerf, and names are bytes in it, since they may be no UTF-8.
#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/pickling.h"
#include "python/sizes.h"
#include "python/surface_object.h"
#include "python/values.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

// `body`: the name of the only region, which the kernel does not keep; empty: there are several, or it has none.
std::shared_ptr<MeshArrays> mesh(const SurfaceObject& surface, const py::object& sizes, const py::object& progress,
                                 const std::string& programs, const std::string& body, const py::kwargs& options) {
    Watch watch(progress);
    const MeshOptions wanted = mesh_options(sizes, programs, options, watch);
    auto made =
        without_lock(watch, [&] { return std::make_shared<MeshArrays>(mesh_to_arrays(surface.surface, wanted)); });
    if (made->region_names.empty() && !body.empty()) made->region_names = {body};
    return made;
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

using MeshClass = py::class_<MeshArrays, std::shared_ptr<MeshArrays>>;

void add_cells_of_mesh(MeshClass& type) {
    type.def_property_readonly("points", array_of(&MeshArrays::vertices),
                               "(n, 3) float64; of order 2 the corners of cells first, then the nodes on edges.")
        .def_property_readonly(
            "order", [](const MeshArrays& self) { return self.quadratic_tets.empty() ? 1 : 2; },
            "Of the cells: 1, or 2 with a node on each edge (order=2 of kerf.mesh()).")
        .def_property_readonly("tetrahedra", array_of(&MeshArrays::tets),
                               "(m, 4) int64: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0.")
        .def_property_readonly(
            "tetra10", array_of(&MeshArrays::quadratic_tets),
            "(m, 10) int64 of order 2, else (0, 10): rows of `points`, the corners as in `tetrahedra`, then the nodes\n"
            "on the edges 01 12 02 03 13 23, as meshio and VTK have them.")
        .def_property_readonly("part", array_of(&MeshArrays::part),
                               "(m,) int32: the part of each tetrahedron, by its number in the tree of cuts.")
        .def_property_readonly("region", array_of(&MeshArrays::region),
                               "(m,) int32: rows of `region_names`, 0 if there is one region.")
        .def_property_readonly(
            "region_names", [](const MeshArrays& self) { return self.region_names; },
            "Empty if there is one region without a name.");
}

void add_triangles_of_mesh(MeshClass& type) {
    type.def_property_readonly("triangles", array_of(&MeshArrays::triangles),
                               "(k, 3) int64: the boundary, counter-clockwise seen from outside, and walls between\n"
                               "regions, each once.")
        .def_property_readonly(
            "triangle6", array_of(&MeshArrays::quadratic_triangles),
            "(k, 6) int64 of order 2, else (0, 6): the corners as in `triangles`, then the nodes on\n"
            "the edges 01 12 02.")
        .def_property_readonly("patch", array_of(&MeshArrays::patch), "(k,) int32: rows of `patch_names`.")
        .def_property_readonly("sides", array_of(&MeshArrays::sides),
                               "(k, 2) int32: the regions behind and in front of each triangle, -1: outside.")
        .def_property_readonly(
            "patch_names", [](const MeshArrays& self) { return self.patch_names; },
            "Names of the patches, in the order of their numbers.");
}

// Adds what kerf/mesh.py makes its methods of.
void add_hidden_of_mesh(MeshClass& type) {
    type.def_property_readonly("_report", [](const MeshArrays& self) { return self.report; })
        .def("_neighbours",
             [](const MeshArrays& self) {
                 return owned(measured(self, [](const auto& mesh) { return neighbours_of(mesh); }));
             })
        .def("_cell_quality",
             [](const MeshArrays& self, const std::string& measure) {
                 return owned(measured(self, [&](const auto& mesh) { return cell_quality(mesh, measure); }));
             })
        .def("_quality",
             [](const MeshArrays& self) {
                 const QualityTexts texts = measured(self, [](const auto& mesh) { return quality_texts(mesh); });
                 return py::make_tuple(texts.json, texts.text);
             })
        .def(
            "_save",
            [](const MeshArrays& self, const std::string& path, const std::string& msh_version, bool msh_ascii) {
                Watch watch{py::none()};
                const MeshFileOptions options{msh_version, msh_ascii, watch.is_cancelled()};
                without_lock(watch, [&] { mesh_to_file(self, path, options); });
            },
            py::arg("path"), py::arg("msh_version"), py::arg("msh_ascii"));
}

}  // namespace

void register_mesh(py::module_& module) {
    MeshClass type(module, "Mesh");
    type.def(sharing<MeshArrays>(), py::arg("other")).def(py::pickle(&state_of, &mesh_of_state));
    add_cells_of_mesh(type);
    add_triangles_of_mesh(type);
    add_hidden_of_mesh(type);
    module.def("mesh", &mesh, py::arg("of"), py::arg("sizes"), py::arg("progress"), py::arg("programs"),
               py::arg("body"));
    module.def("mesh_into", &mesh_into, py::arg("of"), py::arg("folder"), py::arg("sizes"), py::arg("progress"),
               py::arg("programs"));
    module.def("mesh_of_run", [](const std::string& folder) {
        const py::gil_scoped_release released;
        return std::make_shared<MeshArrays>(arrays_of_run(folder));
    });
}

}  // namespace kerf::python
