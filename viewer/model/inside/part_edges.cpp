#include "viewer/model/inside/part_edges.h"

#include "base/core/ids.h"

namespace kerf::view {

namespace {

// Takes edges over as they are asked for, each once.
class EdgesInUse {
 public:
    EdgesInUse(const Part& part, EdgePoints& edges)
        : part_(part), edges_(edges), number_(part.edge_nodes.points.size(), -1) {}

    std::int32_t number_of(std::int32_t node, const UndirectedEdge& ends) {
        const std::int64_t e = node - part_.vertex_count();
        if (number_[e] >= 0) return number_[e];
        number_[e] = count_of(edges_.places);
        edges_.places.push_back(part_.edge_nodes.points[e]);
        edges_.ends.push_back({ends[0], ends[1]});
        edges_.node.push_back(node);
        return number_[e];
    }

 private:
    const Part& part_;
    EdgePoints& edges_;
    std::vector<std::int32_t> number_;
};

}  // namespace

void add_edges(const Part& part, PartCells& cells) {
    if (part.order() < 2) return;
    EdgesInUse in_use(part, cells.edges);
    for (std::int64_t t = 0; t < part.tet_count(); ++t) {
        const std::array<std::int32_t, 10> nodes = part.nodes_of_tet(t);
        auto& edges = cells.edges_of_tet.emplace_back();
        for (std::size_t k = 0; k < edges.size(); ++k)
            edges[k] = in_use.number_of(nodes[4 + k], undirected(nodes[tet_edges[k][0]], nodes[tet_edges[k][1]]));
    }
}

void add_edges(const Part& part, NodeSurface& surface) {
    if (part.order() < 2) return;
    EdgesInUse in_use(part, surface.edges);
    for (std::int64_t f = 0; f < std::ssize(part.facets); ++f) {
        const std::array<std::int32_t, 6> nodes = part.nodes_of_facet(f);
        auto& edges = surface.edges_of_facet.emplace_back();
        for (std::size_t k = 0; k < edges.size(); ++k)
            edges[k] =
                in_use.number_of(nodes[3 + k], undirected(nodes[triangle_edges[k][0]], nodes[triangle_edges[k][1]]));
    }
}

}  // namespace kerf::view
