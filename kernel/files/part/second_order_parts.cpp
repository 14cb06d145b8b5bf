#include "files/part/second_order_parts.h"

#include <algorithm>
#include <utility>

namespace kerf {

namespace {

void add_means_of_edges(const EdgeTable& edges, PartValues& values) {
    if (values.of != PartValues::Of::points) return;
    std::visit(
        [&](auto& numbers) {
            const std::int64_t width = values.components;
            numbers.reserve(numbers.size() + edges.size() * width);
            edges.for_all([&](std::int64_t, const UndirectedEdge& edge) {
                for (std::int64_t c = 0; c < width; ++c)
                    numbers.push_back((numbers[width * edge[0] + c] + numbers[width * edge[1] + c]) / 2);
            });
        },
        values.numbers);
}

}  // namespace

void add_edge_nodes(const EdgeNumbers& numbers, const CurvedNodes& curved, Part& part) {
    EdgeNodes& nodes = part.edge_nodes;
    const std::vector<Vec3>& vertices = part.mesh.vertices;
    nodes.edges = EdgeTable(part.mesh.tets, vertices.size());
    nodes.global_id = numbers.of(part, nodes.edges);
    nodes.points.resize(nodes.edges.size());
    nodes.edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
        nodes.points[e] = 0.5 * (vertices[edge[0]] + vertices[edge[1]]);
        const auto found = std::lower_bound(curved.ids.begin(), curved.ids.end(), nodes.global_id[e]);
        if (found != curved.ids.end() && *found == nodes.global_id[e])
            nodes.points[e] = curved.points[found - curved.ids.begin()];
    });
    for (PartValues& values : part.values) add_means_of_edges(nodes.edges, values);
}

SecondOrderParts::SecondOrderParts(const PartSource& parts, EdgeNumbers numbers, CurvedNodes curved)
    : parts_(parts), numbers_(std::move(numbers)), curved_(std::move(curved)), outline_(parts.outline()) {
    outline_.order = 2;
    outline_.edge_nodes = numbers_.total();
    for (const PartIndex index : outline_.parts.ids()) outline_.parts[index].edge_nodes = numbers_.count_of(index);
}

Part SecondOrderParts::load(PartIndex index) const {
    Part part = parts_.load(index);
    add_edge_nodes(numbers_, curved_, part);
    return part;
}

}  // namespace kerf
