// A part as arrays of numpy: kerf.Part is this class itself. Arrays that the part has itself are views; those that are
// put together (nodes of order 2, regions, owners) are copies, made each time. In arrays over nodes the vertices come
// first, then the nodes on edges. A pickle has the bytes in which processes of Kerf send values to each other, which
// only the same version reads; the table of edges is left out, because it follows from the tetrahedra.
#include <algorithm>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "files/part/part.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/pickling.h"
#include "python/values.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

// Returns a member of a part as a view of it.
template <auto member>
py::array view_of(const py::object& self) {
    return view(self.cast<Part&>().*member, self);
}

// Returns values of the vertices, then those of nodes on edges.
template <class T>
py::array of_nodes(const std::vector<T>& of_vertices, const std::vector<T>& of_edges, const py::object& self) {
    if (of_edges.empty()) return view(of_vertices, self);
    std::vector<T> all = of_vertices;
    all.insert(all.end(), of_edges.begin(), of_edges.end());
    return owned(std::move(all));
}

py::array points_of_part(const py::object& self) {
    const Part& part = self.cast<Part&>();
    return of_nodes(part.mesh.vertices, part.edge_nodes.points, self);
}

py::array ids_of_part(const py::object& self) {
    const Part& part = self.cast<Part&>();
    return of_nodes(part.global_id, part.edge_nodes.global_id, self);
}

py::array tetra10_of(const Part& part) {
    std::vector<std::array<std::int32_t, 10>> rows;
    for (std::int64_t t = 0; part.order() == 2 && t < part.tet_count(); ++t) rows.push_back(part.nodes_of_tet(t));
    return owned(std::move(rows));
}

py::array triangle6_of(const Part& part) {
    std::vector<std::array<std::int32_t, 6>> rows;
    for (std::int64_t f = 0; part.order() == 2 && f < std::ssize(part.facets); ++f)
        rows.push_back(part.nodes_of_facet(f));
    return owned(std::move(rows));
}

py::array_t<std::int32_t> regions_of(const Part& part) {
    py::array_t<std::int32_t> regions(part.tet_count());
    std::fill_n(regions.mutable_data(), part.tet_count(), 0);
    for (const RegionRun& run : part.regions)
        std::fill(regions.mutable_data() + run.first_tet, regions.mutable_data() + part.tet_count(),
                  run.region.value());
    return regions;
}

py::array_t<std::int32_t> owners_of(const Part& part) {
    std::vector<NodeId> owners = owners_of_vertices(part);
    owners.resize(part.node_count(), part.id);
    if (part.order() == 2)
        for (const SharedEdgeGroup& group : part.shared_edges)
            for (const auto& [a, b] : group.edges)
                owners[part.first_edge_node() + part.edge_nodes.edges.find(undirected(a, b))] = group.parts.front();
    py::array_t<std::int32_t> numbers(std::ssize(owners));
    std::transform(owners.begin(), owners.end(), numbers.mutable_data(), [](NodeId owner) { return owner.value(); });
    return numbers;
}

py::list shared_of(const py::object& self) {
    py::list list;
    const py::object type = py::module_::import("kerf.records").attr("SharedPoints");
    for (const SharedGroup& group : self.cast<Part&>().shared) {
        std::vector<std::int32_t> parts;
        for (const NodeId part : group.parts) parts.push_back(part.value());
        list.append(type(parts, view(group.vertices, self)));
    }
    return list;
}

// Returns the values of a solution, of points or of tetrahedra, by name: (n,) or (n, components).
py::dict values_of(const py::object& self, PartValues::Of of) {
    py::dict values;
    for (const PartValues& each : self.cast<Part&>().values) {
        if (each.of != of) continue;
        values[py::str(each.name)] = std::visit(
            [&](const auto& numbers) -> py::array {
                std::vector<py::ssize_t> shape = {std::ssize(numbers) / each.components};
                if (each.components > 1) shape.push_back(each.components);
                return view(numbers.data(), shape, self);
            },
            each.numbers);
    }
    return values;
}

// Archives a part but for the values of its solution, and but for its edges, which follow from the tetrahedra.
template <class Archive, class AnyPart>
void archive_mesh(Archive& a, AnyPart& part) {
    a(part.id, part.mesh.vertices, part.mesh.boundary_vertex_count, part.mesh.tets, part.mesh.neighbours, part.facets,
      part.patch, part.facet, part.neighbour, part.tet_at_facet, part.global_id, part.patch_names, part.region_names,
      part.regions, part.contact_vertices, part.contact_edges, part.shared, part.shared_edges, part.edge_nodes.points,
      part.edge_nodes.global_id);
}

void write_part(ByteWriter& writer, const Part& part) {
    archive_mesh(writer, part);
    writer(std::uint64_t{part.values.size()});
    for (const PartValues& each : part.values) {
        writer(each.name, each.of, std::int32_t{each.components}, std::int32_t{each.is_double()});
        std::visit([&](const auto& numbers) { writer(numbers); }, each.numbers);
    }
}

void read_part(ByteReader& reader, Part& part) {
    archive_mesh(reader, part);
    if (!part.edge_nodes.points.empty()) part.edge_nodes.edges = EdgeTable(part.mesh.tets, part.mesh.vertices.size());
    std::uint64_t count = 0;
    for (reader(count); count > 0; --count) {
        PartValues each;
        std::int32_t components = 0, is_double = 0;
        reader(each.name, each.of, components, is_double);
        each.components = components;
        if (is_double) each.numbers.emplace<std::vector<double>>();
        std::visit([&](auto& numbers) { reader(numbers); }, each.numbers);
        part.values.push_back(std::move(each));
    }
}

using PartClass = py::class_<Part, std::shared_ptr<Part>>;

void add_cells_of_part(PartClass& type) {
    type.def_property_readonly(
            "number", [](const Part& self) { return self.id.value(); },
            "In the tree of cuts: the root is 1, the children of i are 2i and 2i + 1.")
        .def_property_readonly(
            "points", &points_of_part,
            "(n, 3) float64; those of the triangles come first, and of order 2 the nodes on edges behind all corners.")
        .def_property_readonly("order", &Part::order, "Of the cells: 1 or 2.")
        .def_property_readonly(
            "tetra10", &tetra10_of,
            "(m, 10) int32 of order 2, else (0, 10): rows of `points` as Mesh.tetra10 has them; made\n"
            "at each call.")
        .def_property_readonly("triangle6", &triangle6_of,
                               "(k, 6) int32 of order 2, else (0, 6): as Mesh.triangle6 has them; made at each call.")
        .def_property_readonly(
            "boundary_points", [](const Part& self) { return self.mesh.boundary_vertex_count; },
            "How many corners the triangles have.")
        .def_property_readonly(
            "global_ids", &ids_of_part,
            "(n,) int64: numbers of the points in the whole mesh, from 0, equal in all parts that have the point.")
        .def_property_readonly(
            "owner", &owners_of,
            "(n,) int32: the number of the part that owns each point: the first in `run.parts` that has it.")
        .def_property_readonly(
            "tetrahedra", [](const py::object& self) { return view(self.cast<Part&>().mesh.tets, self); },
            "(m, 4) int32: corners a, b, c, d as rows of `points`, with det[b-a, c-a, d-a] > 0.")
        .def_property_readonly("region", &regions_of, "(m,) int32: rows of `region_names`, 0 if there is one region.")
        .def_property_readonly(
            "region_names", [](const Part& self) { return self.region_names.names(); },
            "Empty if there is one region.");
}

void add_triangles_of_part(PartClass& type) {
    type.def_property_readonly(
            "triangles", &view_of<&Part::facets>,
            "(k, 3) int32: corners as rows of `points`, counter-clockwise seen from outside of the part.")
        .def_property_readonly("patch", &view_of<&Part::patch>, "(k,) int32: rows of `patch_names`, -1 on interfaces.")
        .def_property_readonly(
            "patch_names", [](const Part& self) { return self.patch_names.names(); },
            "Names of the patches, in the order of their numbers.")
        .def_property_readonly(
            "neighbour", &view_of<&Part::neighbour>,
            "(k,) int32: the number of the part behind an interface or a wall, -1 on the outer boundary.")
        .def_property_readonly("facet", &view_of<&Part::facet>,
                               "(k,) int32: the triangle of the surface that it is or lies in, -1 on interfaces.")
        .def_property_readonly("tetrahedron", &view_of<&Part::tet_at_facet>,
                               "(k,) int32: the row of `tetrahedra` behind each triangle.")
        .def_property_readonly("shared", &shared_of,
                               "All points that other parts have, too: what ghosts and exchanges are made of.");
}

void add_values_of_part(PartClass& type) {
    type.def_property_readonly(
            "point_data", [](const py::object& self) { return values_of(self, PartValues::Of::points); },
            "Of a solution: (n,) or (n, components) floats by name, as \"Displacement\"; else empty.")
        .def_property_readonly(
            "cell_data", [](const py::object& self) { return values_of(self, PartValues::Of::tets); },
            "Of a solution: (m,) or (m, components) floats by name, as \"Stress\"; else empty.");
}

}  // namespace

void register_part(py::module_& module) {
    PartClass type(module, "Part",
                   "The mesh of one part, and how it belongs to the whole. Its arrays are read-only views; nothing\n"
                   "changes them.\n\n"
                   "Triangles lie on the surface, or where another part has the same triangle, turned, over the same\n"
                   "global numbers: on an interface, or on a wall between two regions.");
    type.def(pickled_as_bytes<Part>(&write_part, &read_part))
        .def("__copy__", [](const py::object& self) { return self; })
        .def("__repr__", [](const Part& self) {
            return fmt::format("<kerf.Part {}: {} points, {} tetrahedra>", self.id.value(), self.node_count(),
                               self.tet_count());
        });
    add_cells_of_part(type);
    add_triangles_of_part(type);
    add_values_of_part(type);
}

}  // namespace kerf::python
