// Groups of neighbouring nodes, each of which is one node of a coarser level.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/multigrid/symmetric_blocks.h"

namespace kerf {

struct Aggregates {
    static constexpr std::int32_t none = -1;
    std::vector<std::int32_t> of_node;  ///< aggregate of each owned node; none for those of `is_apart`
    std::int32_t count = 0;
};

/// Groups nodes as Vanek, Mandel and Brezina (1996, vanek1996) do: a node with all its neighbours, where none of them
/// is taken; a node that is left joins a neighbour's group, or begins one. `owned` nodes of the rank are grouped among
/// themselves, in their order; those of `is_apart` are in no group. O(n).
template <int B>
Aggregates aggregate(const SymmetricBlocks<B>& upper, const LowerBlocks& lower, std::int32_t owned,
                     const std::vector<std::uint8_t>& is_apart) {
    Aggregates found;
    found.of_node.assign(owned, Aggregates::none);
    const auto visit_neighbours = [&](std::int32_t n, auto visit) {
        for (std::int64_t i = lower.first[n]; i < lower.first[n + 1]; ++i)
            if (lower.rows[i] < owned && !is_apart[lower.rows[i]]) visit(lower.rows[i]);
        for (std::int64_t i = upper.first[n] + 1; i < upper.first[n + 1]; ++i)
            if (upper.columns[i] < owned && !is_apart[upper.columns[i]]) visit(upper.columns[i]);
    };
    const auto is_taken = [&](std::int32_t n) { return found.of_node[n] != Aggregates::none; };
    for (std::int32_t n = 0; n < owned; ++n) {
        bool is_free = !is_apart[n] && !is_taken(n);
        if (is_free) visit_neighbours(n, [&](std::int32_t m) { is_free = is_free && !is_taken(m); });
        if (!is_free) continue;
        found.of_node[n] = found.count;
        visit_neighbours(n, [&](std::int32_t m) { found.of_node[m] = found.count; });
        ++found.count;
    }
    const std::vector<std::int32_t> first_ones = found.of_node;
    for (std::int32_t n = 0; n < owned; ++n) {
        if (is_apart[n] || is_taken(n)) continue;
        visit_neighbours(n, [&](std::int32_t m) {
            if (!is_taken(n)) found.of_node[n] = first_ones[m];
        });
    }
    for (std::int32_t n = 0; n < owned; ++n) {
        if (is_apart[n] || is_taken(n)) continue;
        found.of_node[n] = found.count;
        visit_neighbours(n, [&](std::int32_t m) {
            if (!is_taken(m)) found.of_node[m] = found.count;
        });
        ++found.count;
    }
    return found;
}

}  // namespace kerf
