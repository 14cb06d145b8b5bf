#include "prepare/interface_match.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace kerf {

namespace {

// Facets that straight cuts have split share a key, so corners belong to the name of a facet.
NamedTriangle unoriented(const NamedTriangle& t) { return std::min(t, reversed(t)); }

auto name_of(const InterfaceSide& side) { return std::tuple(side.facet, unoriented(side.vertices)); }

NamedTriangle corner_keys(const SurfaceArrays& surface, std::size_t facet) {
    const Triangle& t = surface.facets[facet];
    return rotated_to_smallest({surface.vertex_key[t[0]], surface.vertex_key[t[1]], surface.vertex_key[t[2]]});
}

bool opposite(const InterfaceSide& a, const InterfaceSide& b) {
    return a.leaf != b.leaf && a.vertices == reversed(b.vertices);
}

}  // namespace

InterfaceTable::InterfaceTable(Communicator& ranks, const std::vector<Leaf>& leaves, std::span<const FacetSides> sides)
    : facet_sides_(sides) {
    std::vector<InterfaceSide> own;
    for (const Leaf& leaf : leaves)
        for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f)
            if (is_shared(leaf.surface.facet_key[f]))
                own.push_back({leaf.surface.facet_key[f], corner_keys(leaf.surface, f), leaf.id});
    sides_ = gather_items(ranks, own);
    std::sort(sides_.begin(), sides_.end(), [](const InterfaceSide& a, const InterfaceSide& b) {
        return std::tuple_cat(name_of(a), std::tuple(a.leaf)) < std::tuple_cat(name_of(b), std::tuple(b.leaf));
    });
}

bool InterfaceTable::is_shared(Key facet) const {
    if (is_of_cut(facet)) return true;
    return !facet_sides_.empty() && facet_sides_[static_cast<std::size_t>(key_index(facet))].is_wall();
}

std::vector<NodeId> InterfaceTable::neighbours(const Leaf& leaf) const {
    std::vector<NodeId> neighbours(leaf.surface.facets.size(), -1);
    for (std::size_t f = 0; f < neighbours.size(); ++f) {
        if (!is_shared(leaf.surface.facet_key[f])) continue;
        const auto wanted = name_of({leaf.surface.facet_key[f], corner_keys(leaf.surface, f), leaf.id});
        for (auto it = std::lower_bound(sides_.begin(), sides_.end(), wanted,
                                        [](const InterfaceSide&side, const auto&name) { return name_of(side) < name; });
             it != sides_.end() && name_of(*it) == wanted; ++it)
            if (it->leaf != leaf.id) neighbours[f] = it->leaf;
    }
    return neighbours;
}

SharedVertices InterfaceTable::shared_vertices(const VertexNumbering& numbering, const std::vector<NodeId>& leaves,
                                               std::vector<SharedVertices::Incidence> contacts) const {
    std::map<NodeId, PartIndex> index_of;
    for (const NodeId leaf : leaves) index_of.emplace(leaf, PartIndex(index_of.size()));
    std::vector<SharedVertices::Incidence> held = std::move(contacts);
    held.reserve(held.size() + 3 * sides_.size());
    for (const InterfaceSide& side : sides_)
        for (const Key vertex : side.vertices) held.push_back({numbering.global_id(vertex), index_of.at(side.leaf)});
    return {std::move(held), leaves};
}

std::int64_t InterfaceTable::unmatched() const {
    std::int64_t count = 0;
    for (std::size_t i = 0, j = 0; i < sides_.size(); i = j) {
        while (j < sides_.size() && name_of(sides_[j]) == name_of(sides_[i])) ++j;
        count += j - i != 2 || !opposite(sides_[i], sides_[i + 1]);
    }
    return count;
}

}  // namespace kerf
