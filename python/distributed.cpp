// A distributed mesh in this process: one RankMesh, of which kerf.LocalMesh is the arrays and kerf.DistributedMesh
// (kerf/distributed.py) the counts and names of the whole. That adds what the ranks do together, by mpi4py.
#include <numeric>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/parallel/communicator.h"
#include "kerf/mesh_on_ranks.h"
#include "kerf/rank_mesh.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/surface_object.h"
#include "python/values.h"

namespace kerf::python {

namespace py = pybind11;

// The value of a kerf.LocalMesh.
struct LocalObject {
    std::shared_ptr<RankMesh> mesh;
};

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

py::list neighbour_rows(const py::object& self) {
    py::list neighbours;
    for (const RankNeighbour& each : self.cast<RankMesh&>().neighbours)
        neighbours.append(py::make_tuple(each.rank, view(each.vertices, self), view(each.triangles, self),
                                         view(each.tet_behind, self)));
    return neighbours;
}

// Returns the getter of a member of the mesh: a view of it.
template <class Values>
auto local_array(Values RankMesh::*member) {
    return [member](const py::object& self) { return view((*self.cast<LocalObject&>().mesh).*member, self); };
}

py::array_t<std::int64_t> global_cells(const LocalObject& self) {
    py::array_t<std::int64_t> cells(std::ssize(self.mesh->tets));
    std::iota(cells.mutable_data(), cells.mutable_data() + cells.size(), self.mesh->first_tet);
    return cells;
}

using LocalClass = py::class_<LocalObject>;

void add_cells_of_rank(LocalClass& type) {
    type.def_property_readonly("points", local_array(&RankMesh::vertices), "(n, 3) float64.")
        .def_property_readonly(
            "global_points", local_array(&RankMesh::global_vertices),
            "(n,) int64: numbers of the points in the whole mesh, the same for any number of ranks: rows of the\n"
            "`points` that kerf.mesh() gives without ranks.")
        .def_property_readonly("owner", local_array(&RankMesh::owner),
                               "(n,) int32: the rank that owns the point, the first of those that have it.")
        .def_property_readonly("tetrahedra", local_array(&RankMesh::tets),
                               "(m, 4) int64: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0.")
        .def_property_readonly(
            "first_cell", [](const LocalObject& self) { return self.mesh->first_tet; },
            "The number of the first tetrahedron in the whole mesh; see `global_cells`.")
        .def_property_readonly(
            "global_cells", &global_cells,
            "(m,) int64: numbers of the tetrahedra in the whole mesh, from `first_cell` on without gaps: rows of the\n"
            "`tetrahedra` that kerf.mesh() gives without ranks.")
        .def_property_readonly("part", local_array(&RankMesh::part),
                               "(m,) int32: the part of each tetrahedron, by its number in the tree of cuts.")
        .def_property_readonly("region", local_array(&RankMesh::region),
                               "(m,) int32: rows of DistributedMesh.region_names, 0 if there is one region.");
}

void add_triangles_of_rank(LocalClass& type) {
    type.def_property_readonly(
            "triangles", local_array(&RankMesh::triangles),
            "(k, 3) int64: on patches, rows of `points`, counter-clockwise seen from outside of the tetrahedron "
            "behind.\n\n"
            "A wall between two regions has each triangle once, but on both ranks, each seen from its own side, where\n"
            "it lies between the parts of two; see `triangle_owner`. There are none between parts of one region.")
        .def_property_readonly("cell_behind", local_array(&RankMesh::tet_behind),
                               "(k,) int64: rows of `tetrahedra` that have the triangles as faces.")
        .def_property_readonly("patch", local_array(&RankMesh::patch),
                               "(k,) int32: rows of DistributedMesh.patch_names.")
        .def_property_readonly("sides", local_array(&RankMesh::sides),
                               "(k, 2) int32: the regions behind and in front of each triangle, -1: outside.")
        .def_property_readonly(
            "triangle_owner", local_array(&RankMesh::triangle_owner),
            "(k,) int32: the rank that counts the triangle. Sums over those of the own rank have each triangle once.");
}

}  // namespace

void register_distributed(py::module_& module) {
    py::class_<Communicator>(module, "Communicator");
    LocalClass local(module, "LocalMesh",
                     "Tetrahedra of one rank with all of their corners, the parts of a run one after the other; none\n"
                     "where there are more ranks than parts. Its arrays are read-only views; nothing changes them.");
    add_cells_of_rank(local);
    add_triangles_of_rank(local);
    local.def("__repr__", [](const LocalObject& self) {
        return fmt::format("<kerf.LocalMesh: {} points, {} tetrahedra>", self.mesh->vertices.size(),
                           self.mesh->tets.size());
    });
    py::class_<RankMesh, std::shared_ptr<RankMesh>>(module, "DistributedMesh")
        .def(sharing<RankMesh>(), py::arg("other"))
        .def_property_readonly(
            "local", [](const std::shared_ptr<RankMesh>& self) { return LocalObject{self}; }, "What this rank has.")
        .def_readonly("point_count", &RankMesh::all_vertices, "Of the whole mesh, each point once.")
        .def_readonly("cell_count", &RankMesh::all_tets, "Of the whole mesh.")
        .def_readonly("patch_names", &RankMesh::patch_names, "The same on every rank.")
        .def_readonly("region_names", &RankMesh::region_names, "The same on every rank; empty if there is one region.")
        .def_property_readonly("_neighbour_rows", &neighbour_rows);
    module.def("mesh_of_rank", &mesh_of_rank, py::call_guard<py::gil_scoped_release>(), py::arg("folder"),
               py::arg("rank"), py::arg("ranks"));
    module.def("mesh_on_ranks", &mesh_on_ranks_into, py::arg("ranks"), py::arg("processors"), py::arg("of"),
               py::arg("folder"), py::arg("sizes"), py::arg("progress"), py::arg("programs"));
}

}  // namespace kerf::python
