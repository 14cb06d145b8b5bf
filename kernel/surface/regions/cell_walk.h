// A walk through the cells of facets, from the unbounded cell to its neighbours and on to theirs.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/core/ids.h"
#include "surface/regions/cells.h"

namespace kerf {

/// The facets on the boundary of each cell, by which a walk comes to the cells beyond them. Keeps the reference.
class CellWalk {
 public:
    explicit CellWalk(const Cells& cells) : cells_(cells), first_(cells.count + 2, 0) {
        for (const auto [front, back] : cells.sides)
            for (const std::int32_t cell : {front, back}) ++first_[cell + 2];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        facets_.resize(2 * cells.sides.size());
        std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
        for (std::int32_t f = 0; f < count_of(cells.sides); ++f)
            for (const std::int32_t cell : {cells.sides[f].front, cells.sides[f].back}) facets_[next[cell + 1]++] = f;
    }

    /// Calls enter(from, facet, to) once for each bounded cell `to`, breadth first; `from` is the unbounded cell, -1,
    /// or a cell that was entered before. O(#F).
    template <class Enter>
    void run(Enter enter) const {
        std::vector<char> is_seen(cells_.count + 1, 0);
        std::vector<std::int32_t> order = {-1};
        is_seen[0] = 1;
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::int32_t k = first_[order[i] + 1]; k < first_[order[i] + 2]; ++k) {
                const auto [front, back] = cells_.sides[facets_[k]];
                const std::int32_t to = front == order[i] ? back : front;
                if (std::exchange(is_seen[to + 1], char{1})) continue;
                enter(order[i], facets_[k], to);
                order.push_back(to);
            }
    }

 private:
    const Cells& cells_;
    std::vector<std::int32_t> first_, facets_;  // facets of cell c: [first_[c + 1], first_[c + 2])
};

}  // namespace kerf
