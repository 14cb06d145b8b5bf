// Vertices or edges that parts have in common, as far as the parts of one rank are concerned.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/core/threads.h"
#include "base/parallel/shares.h"
#include "run/prepare/leaf_owners.h"

namespace kerf {

/// Brings incidences of all ranks together; each is a thing and a part that has it (SharedVertices, SharedEdges).
/// Returns all incidences of the things that a part of this rank has, whichever rank has told them: ascending, each
/// once, and none of a thing that only one part has. `number`: of the thing of an incidence; different things may have
/// the same. `is_of_same`: whether two incidences, which follow each other in their order, are of one thing.
/// Collective. Each thing is looked at by one rank, so that memory and messages of a rank follow the incidences that it
/// tells and gets.
template <class Incidence, class Number, class IsOfSame>
std::vector<Incidence> incidences_of_rank(Communicator& ranks, const LeafOwners& leaves, std::vector<Incidence> told,
                                          const Number& number, const IsOfSame& is_of_same) {
    const auto in_order = [](std::vector<Incidence>& incidences) {
        sort_on_threads(incidences);
        incidences.erase(std::unique(incidences.begin(), incidences.end()), incidences.end());
    };
    const auto merged = [&](std::vector<std::vector<Incidence>> lists) {
        std::vector<Incidence> all = std::move(lists.front());
        for (std::size_t r = 1; r < lists.size(); ++r) all.insert(all.end(), lists[r].begin(), lists[r].end());
        in_order(all);
        return all;
    };
    in_order(told);
    std::vector<std::vector<Incidence>> lists(ranks.size());
    for (const Incidence& incidence : told) lists[rank_of_number(number(incidence), ranks)].push_back(incidence);
    told = merged(exchange_items(ranks, std::exchange(lists, std::vector<std::vector<Incidence>>(lists.size()))));
    std::vector<int> holders;
    for (auto first = told.begin(), last = first; first != told.end(); first = last) {
        last = std::find_if(first, told.end(), [&](const Incidence& other) { return !is_of_same(other, *first); });
        if (last - first < 2) continue;
        holders.clear();
        for (auto held = first; held != last; ++held) holders.push_back(leaves.rank_of(held->part));
        std::sort(holders.begin(), holders.end());
        holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
        for (const int holder : holders) lists[holder].insert(lists[holder].end(), first, last);
    }
    return merged(exchange_items(ranks, std::move(lists)));
}

}  // namespace kerf
