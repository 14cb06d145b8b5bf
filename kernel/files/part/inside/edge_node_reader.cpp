#include "files/part/inside/edge_node_reader.h"

#include <array>
#include <utility>

namespace kerf {

namespace {

// Calls visit(cell, nodes) with the rows of the array that is open.
template <std::size_t nodes, class Visit>
void visit_rows(PartArraysFile& file, std::int64_t count, const Visit& visit) {
    std::int64_t cell = 0;
    file.visit<std::array<std::int32_t, nodes>>(
        count, [&](const std::array<std::int32_t, nodes>& row) { visit(cell++, row); });
}

template <std::size_t N>
void require_nodes(const PartArraysFile& file, std::int64_t cell, const std::array<std::int32_t, N>& row,
                   const std::array<std::int32_t, N>& expected) {
    if (row != expected) file.fail(fmt::format("a node of cell {} is not that of its edge", cell));
}

bool has_edges_of(const EdgeTable& edges, const Triangle& facet) {
    return std::all_of(triangle_edges.begin(), triangle_edges.end(), [&](const std::array<int, 2>& e) {
        return edges.contains(undirected(facet[e[0]], facet[e[1]]));
    });
}

}  // namespace

void find_edges(PartArraysFile& file, Part& part) {
    const VtuHeader& header = file.header();
    const std::int64_t tets = part.tet_count(), facets = std::ssize(part.facets);
    EdgeTable& edges = part.edge_nodes.edges;
    edges = tets > 0 ? EdgeTable(part.mesh.tets, header.vertex_count) : EdgeTable(part.facets, header.vertex_count);
    const std::int64_t nodes = header.point_count - header.vertex_count;
    if (std::ssize(edges) != nodes) file.fail(fmt::format("it has {} nodes for {} edges", nodes, edges.size()));
    if (!std::all_of(part.facets.begin(), part.facets.end(),
                     [&](const Triangle& facet) { return has_edges_of(edges, facet); }))
        file.fail("an edge of a triangle is none of a tetrahedron");
    file.open<std::int32_t>("connectivity", 10 * tets + 6 * facets);
    visit_rows<10>(file, tets, [&](std::int64_t t, const std::array<std::int32_t, 10>& row) {
        require_nodes(file, t, row, part.nodes_of_tet(t));
    });
    visit_rows<6>(file, facets, [&](std::int64_t f, const std::array<std::int32_t, 6>& row) {
        require_nodes(file, tets + f, row, part.nodes_of_facet(f));
    });
}

namespace {

// Returns the values of an array over the points of the file, at some of these points, ascending.
template <class T>
std::vector<T> values_at(PartArraysFile& file, const char* array, const std::vector<std::int32_t>& points) {
    std::vector<T> values;
    values.reserve(points.size());
    std::int32_t point = 0;
    file.open<T>(array, file.header().point_count);
    file.visit<T>(file.header().point_count, [&](const T& value) {
        if (values.size() < points.size() && points[values.size()] == point) values.push_back(value);
        ++point;
    });
    return values;
}

}  // namespace

void add_edge_nodes_of_surface(const std::string& part_file, Part& surface) {
    const PartCellCounts counts = read_cell_counts(part_file);
    PartArraysFile file(part_file);
    const VtuHeader& header = file.header();
    EdgeNodes& nodes = surface.edge_nodes;
    nodes.edges = EdgeTable(surface.facets, surface.global_id.size());
    std::vector<std::int32_t> place(nodes.edges.size(), -1);  // of the node of each edge in the file
    if (header.order != 2 || counts.facets != std::ssize(surface.facets) ||
        header.boundary_vertex_count != std::ssize(surface.global_id))
        file.fail("it is not the part of order 2 that its surface bounds");
    file.open<std::int32_t>("connectivity", 10 * counts.tets + 6 * counts.facets);
    file.skip<std::array<std::int32_t, 10>>(counts.tets);
    visit_rows<6>(file, counts.facets, [&](std::int64_t f, const std::array<std::int32_t, 6>& row) {
        const Triangle& facet = surface.facets[f];
        if (!std::equal(facet.begin(), facet.end(), row.begin())) file.fail("it has other triangles than its surface");
        for (std::size_t e = 0; e < triangle_edges.size(); ++e) {
            const auto& [i, j] = triangle_edges[e];
            place[nodes.edges.find(undirected(facet[i], facet[j]))] = row[3 + e];
        }
    });
    // Edges of the surface have the order that they have among those of the part.
    if (!std::is_sorted(place.begin(), place.end()) || (!place.empty() && place.front() < header.vertex_count) ||
        (!place.empty() && place.back() >= header.point_count))
        file.fail("nodes of its triangles are not those of their edges");
    nodes.global_id = values_at<std::int64_t>(file, "GlobalVertexId", place);
    nodes.points = values_at<Vec3>(file, "Points", place);
    if (nodes.global_id.size() != place.size()) file.fail("two edges of its triangles have one node");
}

}  // namespace kerf
