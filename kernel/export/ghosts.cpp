#include "export/ghosts.h"

#include <algorithm>

#include "export/whole_mesh.h"

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

// Which vertices of the part another one has, too.
std::vector<bool> vertices_shared_with(NodeId id, const Part& part) {
    std::vector<bool> is_shared(part.mesh.vertices.size());
    for (const SharedGroup& group : part.shared)
        if (std::find(group.parts.begin(), group.parts.end(), id) != group.parts.end())
            for (const std::int32_t v : group.vertices) is_shared[v] = true;
    return is_shared;
}

// Adds what the part `id` needs of another one, whose cells are numbered from `first`.
void add_ghosts(NodeId id, const Part& other, PartIndex index, std::int64_t first, Ghosts& ghosts) {
    const std::vector<bool> shared = vertices_shared_with(id, other);
    const auto is_shared = [&](std::int32_t v) { return shared[v]; };
    for (std::int64_t t = 0; t < other.tet_count(); ++t) {
        const Tetrahedron& tet = other.mesh.tets[t];
        if (std::none_of(tet.begin(), tet.end(), is_shared)) continue;
        ghosts.cells.push_back({first + t, index, global_corners(other, tet)});
        for (const std::int32_t v : tet)
            if (!is_shared(v)) ghosts.vertices.push_back({other.global_id[v], other.mesh.vertices[v]});
    }
}

}  // namespace

Ghosts ghosts_of(const PartSource& parts, const Part& part) {
    const MeshOutline& outline = parts.outline();
    Ghosts ghosts;
    for (const PartIndex index : neighbours_of(outline, part))
        add_ghosts(part.id, parts.load(index), index, outline.first_tet(index), ghosts);
    std::vector<GhostVertex>& vertices = ghosts.vertices;
    std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const auto end =
        std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
    vertices.erase(end, vertices.end());
    return ghosts;
}

}  // namespace kerf
