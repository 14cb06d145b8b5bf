// Pairs up what shares an edge, twice each.
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "core/types.h"

namespace kerf {

/// A small hash table for a closed fan of triangles: every edge is asked for twice.
class EdgeTable {
 public:
    /// Forgets everything and makes room for so many edges. Linear in them.
    void reset(std::size_t edges) {
        const std::size_t size = std::bit_ceil(3 * edges);
        entries_.assign(size, {empty, 0});
        mask_ = size - 1;
    }

    /// The value that the edge was given first; where this is the first time, it is given `value`, and -1 is returned.
    std::int32_t match(std::int32_t a, std::int32_t b, std::int32_t value) {
        const auto [low, high] = undirected(a, b);
        const std::uint64_t edge = static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32 |
                                   static_cast<std::uint32_t>(high);
        std::size_t i = (edge * 0x9e3779b97f4a7c15) >> 40 & mask_;
        for (; entries_[i].edge != edge; i = (i + 1) & mask_)
            if (entries_[i].edge == empty) {
                entries_[i] = {edge, value};
                return -1;
            }
        return entries_[i].value;
    }

 private:
    struct Entry {
        std::uint64_t edge;
        std::int32_t value;
    };
    static constexpr std::uint64_t empty = ~std::uint64_t{0};

    std::vector<Entry> entries_;
    std::size_t mask_ = 0;
};

}  // namespace kerf
