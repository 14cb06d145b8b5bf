#include "export/ghosts.h"

#include <algorithm>

namespace kerf {

namespace {

// The parts that share a vertex with this one, ascending.
std::vector<PartIndex> neighbours_of(const MeshOutline& outline, const Part& part) {
    std::vector<NodeId> ids;
    for (const SharedGroup& group : part.shared) ids.insert(ids.end(), group.parts.begin(), group.parts.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::vector<PartIndex> indices;
    for (const NodeId id : ids)
        if (id != part.id) indices.push_back(outline.index_of(id));
    std::sort(indices.begin(), indices.end());
    return indices;
}

// Which nodes of the part another one has, too.
std::vector<bool> nodes_shared_with(NodeId id, const Part& part) {
    std::vector<bool> is_shared(part.node_count());
    for_each_shared_group(part, [&](const std::vector<NodeId>& parts, const std::vector<std::int32_t>& nodes) {
        if (std::find(parts.begin(), parts.end(), id) == parts.end()) return;
        for (const std::int32_t n : nodes) is_shared[n] = true;
    });
    return is_shared;
}

// Adds what the part `id` needs of another one, whose cells are numbered from `first`.
void add_ghosts(NodeId id, const Part& other, PartIndex index, std::int64_t first, Ghosts& ghosts) {
    const std::vector<bool> shared = nodes_shared_with(id, other);
    const auto is_shared = [&](std::int32_t v) { return shared[v]; };
    const auto add_nodes = [&](const auto& nodes) {
        for (const std::int32_t n : nodes)
            if (!is_shared(n)) ghosts.nodes.push_back({other.node_id(n), other.node_point(n)});
    };
    for (std::int64_t t = 0; t < other.tet_count(); ++t) {
        const Tetrahedron& tet = other.mesh.tets[t];
        if (std::none_of(tet.begin(), tet.end(), is_shared)) continue;
        ghosts.cells.push_back({first + t, index, nodes_of_tet(other, t)});
        other.order() == 1 ? add_nodes(tet) : add_nodes(other.nodes_of_tet(t));
    }
}

}  // namespace

Ghosts ghosts_of(const PartSource& parts, const Part& part) {
    const MeshOutline& outline = parts.outline();
    Ghosts ghosts;
    for (const PartIndex index : neighbours_of(outline, part))
        add_ghosts(part.id, parts.load(index), index, outline.first_tet(index), ghosts);
    std::vector<GhostNode>& nodes = ghosts.nodes;
    std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const auto end = std::unique(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
    nodes.erase(end, nodes.end());
    return ghosts;
}

}  // namespace kerf
