#include "run/interface_match.h"

#include <algorithm>
#include <tuple>

namespace kerf {

namespace {

bool opposite(const InterfaceSide& a, const InterfaceSide& b) {
    return a.leaf != b.leaf && a.vertices == reversed(b.vertices);
}

}  // namespace

InterfaceTable::InterfaceTable(Communicator& ranks, const std::vector<Leaf>& leaves) {
    std::vector<InterfaceSide> own;
    for (const Leaf& leaf : leaves)
        for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f) {
            if (key_node(leaf.surface.facet_key[f]) == 0) continue;
            const Triangle& t = leaf.surface.facets[f];
            const std::vector<Key>& key = leaf.surface.vertex_key;
            own.push_back({leaf.surface.facet_key[f], rotated_to_smallest({key[t[0]], key[t[1]], key[t[2]]}), leaf.id});
        }
    for (const std::vector<InterfaceSide>& sides : all_gather(ranks, own))
        sides_.insert(sides_.end(), sides.begin(), sides.end());
    std::sort(sides_.begin(), sides_.end(), [](const InterfaceSide& a, const InterfaceSide& b) {
        return std::tie(a.facet, a.leaf) < std::tie(b.facet, b.leaf);
    });
}

std::vector<NodeId> InterfaceTable::neighbours(const Leaf& leaf) const {
    std::vector<NodeId> neighbours(leaf.surface.facets.size(), -1);
    for (std::size_t f = 0; f < neighbours.size(); ++f) {
        const Key key = leaf.surface.facet_key[f];
        if (key_node(key) == 0) continue;
        for (auto it = std::lower_bound(sides_.begin(), sides_.end(), key,
                                        [](const InterfaceSide&side, Key k) { return side.facet < k; });
             it != sides_.end() && it->facet == key; ++it)
            if (it->leaf != leaf.id) neighbours[f] = it->leaf;
    }
    return neighbours;
}

std::int64_t InterfaceTable::unmatched() const {
    std::int64_t count = 0;
    for (std::size_t i = 0, j = 0; i < sides_.size(); i = j) {
        while (j < sides_.size() && sides_[j].facet == sides_[i].facet) ++j;
        count += j - i != 2 || !opposite(sides_[i], sides_[i + 1]);
    }
    return count;
}

}  // namespace kerf
