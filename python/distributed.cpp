#include <pybind11/stl.h>

#include "base/parallel/communicator.h"
#include "kerf/mesh_on_ranks.h"
#include "kerf/rank_mesh.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/surface_object.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

// Meshes on ranks that are known as messages alone: kerf._mpi makes them of a communicator of MPI.
void mesh_on_ranks_into(Communicator& ranks, std::int32_t processors, const SurfaceObject& surface,
                        const std::string& folder, const py::object& sizes, const py::object& progress,
                        const std::string& programs, const py::kwargs& options) {
    Watch watch(progress);
    const MeshOptions wanted = mesh_options(sizes, programs, options, watch);
    without_lock(watch, [&] {
        run_together(ranks, [&] { mesh_on_ranks(surface.surface, wanted, folder, processors, ranks); });
    });
}

py::list neighbours_of(const py::object& self) {
    py::list neighbours;
    for (const RankNeighbour& each : self.cast<RankMesh&>().neighbours)
        neighbours.append(py::make_tuple(each.rank, view(each.vertices, self), view(each.triangles, self),
                                         view(each.tet_behind, self)));
    return neighbours;
}

}  // namespace

void register_distributed(py::module_& module) {
    py::class_<Communicator>(module, "Communicator");
    py::class_<RankMesh>(module, "RankMesh")
        .def_property_readonly("points", array_of(&RankMesh::vertices))
        .def_property_readonly("global_points", array_of(&RankMesh::global_vertices))
        .def_property_readonly("owner", array_of(&RankMesh::owner))
        .def_property_readonly("tetrahedra", array_of(&RankMesh::tets))
        .def_readonly("first_cell", &RankMesh::first_tet)
        .def_property_readonly("part", array_of(&RankMesh::part))
        .def_property_readonly("region", array_of(&RankMesh::region))
        .def_property_readonly("triangles", array_of(&RankMesh::triangles))
        .def_property_readonly("cell_behind", array_of(&RankMesh::tet_behind))
        .def_property_readonly("patch", array_of(&RankMesh::patch))
        .def_property_readonly("sides", array_of(&RankMesh::sides))
        .def_property_readonly("triangle_owner", array_of(&RankMesh::triangle_owner))
        .def_property_readonly("neighbours", &neighbours_of)
        .def_readonly("point_count", &RankMesh::all_vertices)
        .def_readonly("cell_count", &RankMesh::all_tets)
        .def_readonly("patch_names", &RankMesh::patch_names)
        .def_readonly("region_names", &RankMesh::region_names);
    module.def("mesh_of_rank", &mesh_of_rank, py::call_guard<py::gil_scoped_release>(), py::arg("folder"),
               py::arg("rank"), py::arg("ranks"));
    module.def("mesh_on_ranks", &mesh_on_ranks_into, py::arg("ranks"), py::arg("processors"), py::arg("of"),
               py::arg("folder"), py::arg("sizes"), py::arg("progress"), py::arg("programs"));
}

}  // namespace kerf::python
