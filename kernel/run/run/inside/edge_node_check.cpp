#include "run/run/inside/edge_node_check.h"

#include <algorithm>

#include "files/part/curved_part.h"
#include "run/run/inside/number_distance.h"

namespace kerf {

void EdgeNodeCheck::add(const Part& part) {
    const EdgeNodes& nodes = part.edge_nodes;
    const std::vector<bool> is_of_others = edges_of_others(part);
    std::vector<bool> is_curved(nodes.edges.size(), false);
    nodes.edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
        const auto& [a, b] = edge;
        is_curved[e] = nodes.points[e] != 0.5 * (part.mesh.vertices[a] + part.mesh.vertices[b]);
        if (!is_of_others[e]) return add_own(nodes.global_id[e], is_curved[e]);
        const auto [low, high] = std::minmax(part.global_id[a], part.global_id[b]);
        shared_.push_back({{low, high}, nodes.global_id[e], nodes.points[e], is_curved[e]});
    });
    invalid_cells_ += count_invalid(part, is_curved);
}

// Marks the edges that other parts may have, too: those of interface triangles, and those of contacts.
std::vector<bool> EdgeNodeCheck::edges_of_others(const Part& part) const {
    const EdgeTable& edges = part.edge_nodes.edges;
    std::vector<bool> found(edges.size(), false);
    const auto mark = [&](std::int32_t a, std::int32_t b) {
        const UndirectedEdge edge = undirected(a, b);
        if (edges.contains(edge)) found[edges.find(edge)] = true;
    };
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (part.is_interface(f))
            for (const auto& [i, j] : triangle_edges) mark(part.facets[f][i], part.facets[f][j]);
    for (const auto& [a, b] : part.contact_edges) mark(a, b);
    return found;
}

void EdgeNodeCheck::add(const EdgeNodeCheck& of_others) {
    shared_.insert(shared_.end(), of_others.shared_.begin(), of_others.shared_.end());
    for (const Range& ids : of_others.own_) add_own(ids);
    count_ += of_others.count_;
    curved_ += of_others.curved_;
    invalid_cells_ += of_others.invalid_cells_;
}

void EdgeNodeCheck::add_own(std::int64_t id, bool is_curved) {
    ++count_;
    curved_ += is_curved;
    add_own(Range{id, static_cast<std::int64_t>(static_cast<std::uint64_t>(id) + 1)});  // id may be any number
}

void EdgeNodeCheck::add_own(const Range& ids) {
    if (!own_.empty() && own_.back()[1] == ids[0])
        own_.back()[1] = ids[1];
    else
        own_.push_back(ids);
}

std::int64_t EdgeNodeCheck::count_invalid(const Part& part, const std::vector<bool>& is_curved) {
    if (std::find(is_curved.begin(), is_curved.end(), true) == is_curved.end()) return 0;
    std::int64_t invalid = 0;
    for (std::int64_t t = 0; t < part.tet_count(); ++t) {
        const std::array<std::int32_t, 10> nodes = part.nodes_of_tet(t);
        const auto is_on_curve = [&](std::int32_t n) { return is_curved[n - part.first_edge_node()]; };
        if (std::none_of(nodes.begin() + 4, nodes.end(), is_on_curve)) continue;
        invalid += CurvedTetJacobian(places_of_nodes(part, t)).validity() != CellValidity::valid;
    }
    return invalid;
}

void EdgeNodeCheck::finish(std::int64_t vertices, RunVerification& laws) {
    std::stable_sort(shared_.begin(), shared_.end(), [](const Node& a, const Node& b) { return a.edge < b.edge; });
    const Node* last = nullptr;
    for (const Node& node : shared_) {
        if (last && last->edge == node.edge) {
            laws.unequal_edge_nodes += last->id != node.id || last->point != node.point;
            continue;
        }
        add_own(node.id, node.is_curved);
        last = &node;
    }
    std::sort(own_.begin(), own_.end());
    std::int64_t next = vertices;
    for (const auto& [first, end] : own_) {
        laws.misnumbered += number_distance(first, next);
        next = end;
    }
    laws.invalid_curved_cells += invalid_cells_;
}

}  // namespace kerf
