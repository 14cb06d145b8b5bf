#include "solve/equations/inside/material_nodes.h"

#include <algorithm>
#include <compare>

#include "base/core/ids.h"

namespace kerf {

struct MaterialNodes::Pair {
    std::int32_t node;
    MaterialNumber material;
    auto operator<=>(const Pair&) const = default;
};

// Returns a pair for each node and, where cells of other materials meet there, one for each of these; some are there
// several times.
std::vector<MaterialNodes::Pair> MaterialNodes::pairs_of_cells() const {
    const FeSpace& space = *problem_.space;
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> first_seen(space.node_count(), none);
    std::vector<Pair> pairs;
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        const MaterialNumber material = problem_.material_number(p, t);
        for (int i = 0; i < element_nodes(space.order()); ++i) {
            if (first_seen[nodes[i]] == material) continue;
            if (first_seen[nodes[i]] == none) first_seen[nodes[i]] = material;
            pairs.push_back({nodes[i], material});
        }
    });
    return pairs;
}

MaterialNodes::MaterialNodes(const ElasticProblem& problem) : problem_(problem) {
    const FeSpace& space = *problem.space;
    const auto sort_out = [](std::vector<Pair>& all) {
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
    };
    std::vector<Pair> pairs = pairs_of_cells();
    sort_out(pairs);
    const auto count_by_nodes = [&] {
        first_.assign(space.node_count() + 1, 0);
        material_.clear();
        for (const Pair& pair : pairs) ++first_[pair.node + 1];
        for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
        for (const Pair& pair : pairs) material_.push_back(pair.material);
    };
    count_by_nodes();

    // Owners are told the materials of ghosts: the place of the node among those of both ranks, and the material.
    using Told = std::array<std::int32_t, 2>;
    const std::vector<Ownership::Neighbour>& sharers = space.ownership().owned();
    const auto told = space.ownership().lists_to_owners([&](const Ownership::Neighbour& neighbour) {
        std::vector<Told> list;
        for (std::int32_t place = 0; place < count_of(neighbour.items); ++place)
            for (std::int32_t i = first_[neighbour.items[place]]; i < first_[neighbour.items[place] + 1]; ++i)
                list.push_back({place, material_[i]});
        return list;
    });
    const auto for_all_told = [&](std::size_t r, auto take) {
        for (const auto& [place, material] : told[r])
            take(Pair{sharers[r].items[place], static_cast<MaterialNumber>(material)});
    };
    for (std::size_t r = 0; r < told.size(); ++r) for_all_told(r, [&](const Pair& pair) { pairs.push_back(pair); });
    sort_out(pairs);
    count_by_nodes();

    std::vector<Ownership::Neighbour> owned, ghosts;
    for (std::size_t r = 0; r < told.size(); ++r) {
        owned.push_back({sharers[r].rank, {}});
        for_all_told(r, [&](const Pair& pair) { owned.back().items.push_back(number(pair.node, pair.material)); });
    }
    for (const Ownership::Neighbour& neighbour : space.ownership().ghosts()) {
        ghosts.push_back({neighbour.rank, {}});
        for (const std::int32_t node : neighbour.items)
            for (std::int32_t i = first_[node]; i < first_[node + 1]; ++i) ghosts.back().items.push_back(i);
    }
    ownership_ = Ownership(space.ranks(), std::move(owned), std::move(ghosts));
}

std::int32_t MaterialNodes::number(std::int32_t node, MaterialNumber material) const {
    const auto begin = material_.begin();
    return std::lower_bound(begin + first_[node], begin + first_[node + 1], material) - begin;
}

std::array<std::int32_t, most_element_nodes> MaterialNodes::of(std::size_t p, std::size_t tet) const {
    const FeSpace& space = *problem_.space;
    const MaterialNumber material = problem_.material_number(p, tet);
    std::array<std::int32_t, most_element_nodes> numbers = space.nodes_of(p, tet);
    for (int i = 0; i < element_nodes(space.order()); ++i) numbers[i] = number(numbers[i], material);
    return numbers;
}

}  // namespace kerf
