// A hash table with open addressing that finds the first of equal points. The hash only decides which points are
// compared, so no result depends on it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Returns a hash that is the same for equal points; -0 equals 0.
inline std::uint64_t hash_of_point(const Vec3& p) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
        h ^= std::bit_cast<std::uint64_t>(p[i] + 0.0);  // -0 + 0 = 0
        h *= 0x9e3779b97f4a7c15ULL;
        h ^= h >> 32;
    }
    return h;
}

/// A table that finds the first of several vertices with equal coordinates. NaN equals nothing. Vertices that were
/// entered must stay as they are. Takes 8 to 16 bytes for each distinct vertex; expected O(1) a vertex.
class VertexTable {
 public:
    /// Grows beyond `expected` vertices.
    explicit VertexTable(std::size_t expected = 0) : slots_(std::bit_ceil(2 * expected + 16), -1) {}

    /// Prefetches the memory that enter() looks at first: useful some vertices ahead.
    void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & mask()]); }
    /// Enters vertices[v] with its hash_of_point(). Returns the first equal vertex that was entered, which is v if
    /// there was none.
    std::int32_t enter(std::int32_t v, std::uint64_t hash, const std::vector<Vec3>& vertices) {
        const Vec3& p = vertices[v];
        if (p.hasNaN()) return v;  // many of them would only lengthen the probes
        std::size_t slot = hash & mask();
        while (slots_[slot] >= 0 && vertices[slots_[slot]] != p) slot = (slot + 1) & mask();
        if (slots_[slot] >= 0) return slots_[slot];
        slots_[slot] = v;
        if (2 * ++count_ > slots_.size()) grow(vertices);
        return v;
    }

 private:
    std::size_t mask() const { return slots_.size() - 1; }
    void grow(const std::vector<Vec3>& vertices) {
        const std::vector<std::int32_t> old = std::exchange(slots_, std::vector<std::int32_t>(2 * slots_.size(), -1));
        for (const std::int32_t v : old) {
            if (v < 0) continue;
            std::size_t slot = hash_of_point(vertices[v]) & mask();
            while (slots_[slot] >= 0) slot = (slot + 1) & mask();
            slots_[slot] = v;
        }
    }

    std::vector<std::int32_t> slots_;  // a power of two, at most half of them taken; -1: free
    std::size_t count_ = 0;
};

}  // namespace kerf
