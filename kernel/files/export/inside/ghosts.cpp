// A ghost of a part is a cell of another part that shares a vertex with it. The layer of a part are its cells at
// vertices that any other part has, with nodes numbered within the layer, and for each set of parts the nodes that
// these share. From the layers of its neighbours a part takes the cells that have a shared node with it among their
// corners. Layers are kept in slots, one a part, and the least recently used goes when all are larger than the limit. A
// layer that a thread is loading is waited for, not loaded twice; the lock is open meanwhile. Neighbours come in the
// order of the parts and cells in that of their part, so that ghosts are ascending without a sort; nodes are sorted,
// since several parts may have one.
#include "files/export/inside/ghosts.h"

#include <algorithm>
#include <exception>

#include "base/core/ids.h"

namespace kerf {

// The cells of a part at vertices that other parts have, too.
struct GhostLayer {
    struct SharedNodes {
        std::vector<NodeId> parts;
        std::vector<std::int32_t> nodes;  // of the layer
    };
    std::vector<std::int32_t> tets;     // of the part, ascending
    std::vector<std::int32_t> corners;  // nodes of the layer: those of each cell in turn
    std::vector<GhostNode> nodes;
    std::vector<SharedNodes> shared;
    std::size_t bytes = 0;

    std::size_t nodes_of_cell() const { return corners.size() / tets.size(); }
};

namespace {

// Returns the parts that share a vertex with this one, ascending.
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

// Returns the tetrahedra with a vertex that other parts have, too.
std::vector<std::int32_t> tets_at_others(const Part& part) {
    std::vector<bool> is_shared(part.vertex_count(), false);
    for (const SharedGroup& group : part.shared)
        for (const std::int32_t v : group.vertices) is_shared[v] = true;
    std::vector<std::int32_t> tets;
    for (std::int32_t t = 0; t < part.tet_count(); ++t) {
        const Tetrahedron& tet = part.mesh.tets[t];
        if (std::any_of(tet.begin(), tet.end(), [&](std::int32_t v) { return is_shared[v]; })) tets.push_back(t);
    }
    return tets;
}

GhostLayer make_layer(const Part& part) {
    GhostLayer layer;
    layer.tets = tets_at_others(part);
    std::vector<std::int32_t> place(part.node_count(), -1);
    const auto add_nodes = [&](const auto& nodes) {
        for (const std::int32_t n : nodes) {
            if (place[n] < 0) {
                place[n] = count_of(layer.nodes);
                layer.nodes.push_back({part.node_id(n), part.node_point(n)});
            }
            layer.corners.push_back(place[n]);
        }
    };
    for (const std::int32_t t : layer.tets)
        part.order() == 1 ? add_nodes(part.mesh.tets[t]) : add_nodes(part.nodes_of_tet(t));
    for_each_shared_group(part, [&](const std::vector<NodeId>& parts, const std::vector<std::int32_t>& nodes) {
        GhostLayer::SharedNodes& group = layer.shared.emplace_back();
        group.parts = parts;
        for (const std::int32_t n : nodes)
            if (place[n] >= 0) group.nodes.push_back(place[n]);
        layer.bytes += group.parts.size() * sizeof(NodeId) + group.nodes.size() * sizeof(std::int32_t);
    });
    layer.tets.shrink_to_fit();
    layer.corners.shrink_to_fit();
    layer.nodes.shrink_to_fit();
    layer.bytes += sizeof layer + layer.nodes.size() * sizeof(GhostNode) +
                   (layer.tets.size() + layer.corners.size()) * sizeof(std::int32_t);
    return layer;
}

template <std::size_t n>
CellNodes ids_of_cell(const GhostLayer& layer, const std::int32_t* corners) {
    std::array<std::int64_t, n> ids;
    for (std::size_t i = 0; i < n; ++i) ids[i] = layer.nodes[corners[i]].id;
    return CellNodes(ids);
}

// Adds the ghosts that the part `id` has in the layer of another one, whose cells are numbered from `first`.
void add_ghosts(NodeId id, const GhostLayer& layer, PartIndex index, std::int64_t first, Ghosts& ghosts) {
    if (layer.tets.empty()) return;
    std::vector<bool> is_shared(layer.nodes.size(), false);
    for (const auto& group : layer.shared)
        if (std::find(group.parts.begin(), group.parts.end(), id) != group.parts.end())
            for (const std::int32_t n : group.nodes) is_shared[n] = true;
    const std::size_t width = layer.nodes_of_cell();
    const auto is_node_shared = [&](std::int32_t n) { return is_shared[n]; };
    for (std::size_t c = 0; c < layer.tets.size(); ++c) {
        const std::int32_t* corners = layer.corners.data() + c * width;
        if (std::none_of(corners, corners + 4, is_node_shared)) continue;
        ghosts.cells.push_back({first + layer.tets[c], index,
                                width == 4 ? ids_of_cell<4>(layer, corners) : ids_of_cell<10>(layer, corners)});
        for (std::size_t i = 0; i < width; ++i)
            if (!is_shared[corners[i]]) ghosts.nodes.push_back(layer.nodes[corners[i]]);
    }
}

}  // namespace

GhostFinder::GhostFinder(std::size_t most_bytes) : most_bytes_(most_bytes) {}
GhostFinder::~GhostFinder() = default;

Ghosts GhostFinder::ghosts_of(const PartSource& parts, const Part& part) {
    const MeshOutline& outline = parts.outline();
    Ghosts ghosts;
    for (const PartIndex index : neighbours_of(outline, part))
        add_ghosts(part.id, *layer_of(parts, index), index, outline.first_tet(index), ghosts);
    std::vector<GhostNode>& nodes = ghosts.nodes;
    std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const auto end = std::unique(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
    nodes.erase(end, nodes.end());
    return ghosts;
}

// Several threads may want the same layer: the first loads it and the others wait.
std::shared_ptr<const GhostLayer> GhostFinder::layer_of(const PartSource& parts, PartIndex index) {
    std::unique_lock lock(mutex_);
    if (slots_.empty()) slots_.resize(parts.outline().parts.size());
    Slot& slot = slots_[index];
    loaded_.wait(lock, [&] { return !slot.is_loading; });
    slot.last_use = ++uses_;
    if (slot.layer) return slot.layer;
    slot.is_loading = true;
    lock.unlock();
    std::shared_ptr<const GhostLayer> layer;
    std::exception_ptr error;
    try {
        layer = std::make_shared<const GhostLayer>(make_layer(parts.load(index)));
    } catch (...) {
        error = std::current_exception();
    }
    lock.lock();
    slot.is_loading = false;
    loaded_.notify_all();
    if (error) std::rethrow_exception(error);
    slot.layer = layer;
    bytes_ += layer->bytes;
    forget_others(slot);
    return layer;
}

void GhostFinder::forget_others(const Slot& kept) {
    while (bytes_ > most_bytes_) {
        Slot* oldest = nullptr;
        for (Slot& slot : slots_)
            if (slot.layer && &slot != &kept && (!oldest || slot.last_use < oldest->last_use)) oldest = &slot;
        if (!oldest) return;
        bytes_ -= oldest->layer->bytes;
        oldest->layer.reset();
    }
}

}  // namespace kerf
