// Every facet between two leaves has two sides in two leaves, maybe on two ranks. Each rank tells a side to the rank
// that the key of the facet chooses; there all sides are sorted by name, which is the key with the corner keys in a
// canonical rotation and orientation, because pieces of a facet that straight cuts have split share its key. Sides with
// one name are neighbours of each other; a match is perfect if there are two, in two leaves, of opposite orientation.
// The answers are sent back in the order in which sides were told, so that they need no names.
#include "run/prepare/interface_match.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/parallel/shares.h"

namespace kerf {

namespace {

// A side that was told, by its name: facets that straight cuts have split share a key, so corners belong to it.
struct ToldSide {
    Key facet;
    NamedTriangle vertices;  // of this orientation and the reversed one the smaller
    NodeId leaf;
    bool is_reversed;
    std::int32_t rank;  // that has told it
    std::size_t place;  // among the sides that it has told

    auto name() const { return std::tie(facet, vertices); }
    auto order() const { return std::tie(facet, vertices, leaf, is_reversed, rank, place); }
};

using SidesOfRanks = std::vector<std::vector<InterfaceSide>>;
using NeighboursOfRanks = std::vector<std::vector<NodeId>>;

NamedTriangle corner_keys(const SurfaceArrays& surface, std::size_t facet) {
    const Triangle& t = surface.facets[facet];
    return rotated_to_smallest({surface.vertex_key[t[0]], surface.vertex_key[t[1]], surface.vertex_key[t[2]]});
}

// Calls visit(place of leaf, facet) for all facets between leaves.
template <class Visit>
void for_each_shared_facet(const std::vector<Leaf>& leaves, std::span<const FacetSides> sides, Visit visit) {
    for (std::size_t i = 0; i < leaves.size(); ++i)
        for (std::size_t f = 0; f < leaves[i].surface.facet_key.size(); ++f)
            if (is_between_leaves(leaves[i].surface.facet_key[f], sides)) visit(i, f);
}

std::vector<ToldSide> in_order_of_names(SidesOfRanks told) {
    std::vector<ToldSide> all;
    for (std::int32_t rank = 0; rank < count_of(told); ++rank) {
        const std::vector<InterfaceSide> of_rank = std::exchange(told[rank], {});
        for (std::size_t i = 0; i < of_rank.size(); ++i) {
            const InterfaceSide& side = of_rank[i];
            const NamedTriangle turned = reversed(side.vertices);
            const bool is_reversed = turned < side.vertices;
            all.push_back({side.facet, is_reversed ? turned : side.vertices, side.leaf, is_reversed, rank, i});
        }
    }
    sort_on_threads(all, [](const ToldSide& a, const ToldSide& b) { return a.order() < b.order(); });
    return all;
}

// Fills the neighbour of each side, -1 if it has none, and returns how many facets do not match.
std::int64_t match(SidesOfRanks told, NeighboursOfRanks& neighbours) {
    neighbours.resize(told.size());
    for (std::size_t r = 0; r < told.size(); ++r) neighbours[r].assign(told[r].size(), NodeId::none());
    const std::vector<ToldSide> sides = in_order_of_names(std::move(told));
    std::int64_t unmatched = 0;
    for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
        last = std::find_if(first, sides.end(), [&](const ToldSide& s) { return s.name() != first->name(); });
        for (auto side = first; side != last; ++side)
            for (auto other = last; other != first && !neighbours[side->rank][side->place].is_valid(); --other)
                if ((other - 1)->leaf != side->leaf) neighbours[side->rank][side->place] = (other - 1)->leaf;
        const auto are_opposite = [](const ToldSide& a, const ToldSide& b) {
            return a.leaf != b.leaf && a.is_reversed != b.is_reversed;
        };
        unmatched += last - first != 2 || !are_opposite(*first, *(first + 1));
    }
    return unmatched;
}

}  // namespace

InterfaceMatch::InterfaceMatch(Communicator& ranks, const std::vector<Leaf>& leaves,
                               std::span<const FacetSides> sides) {
    const auto owner_of = [&](const SurfaceArrays& surface, std::size_t f) {
        return rank_of_number(surface.facet_key[f], ranks);
    };
    SidesOfRanks told(ranks.size());
    for_each_shared_facet(leaves, sides, [&](std::size_t i, std::size_t f) {
        const SurfaceArrays& surface = leaves[i].surface;
        told[owner_of(surface, f)].push_back({surface.facet_key[f], corner_keys(surface, f), leaves[i].id});
    });
    NeighboursOfRanks found;
    unmatched_ = sum_of(ranks, match(exchange_items(ranks, std::move(told)), found));
    found = exchange_items(ranks, std::move(found));
    for (const Leaf& leaf : leaves) neighbours_.emplace_back(leaf.surface.facets.size(), NodeId::none());
    std::vector<std::size_t> next(found.size(), 0);  // answers come in the order of the sides that were told
    for_each_shared_facet(leaves, sides, [&](std::size_t i, std::size_t f) {
        const std::size_t owner = owner_of(leaves[i].surface, f);
        neighbours_[i][f] = found[owner][next[owner]++];
    });
}

}  // namespace kerf
