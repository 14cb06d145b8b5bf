// Welding by one pass over a hash table with open addressing, filled in the order of the vertices: the first of equals
// is found by every later one. The hash only decides who is compared with whom, so the result does not depend on it.
#include "surface/soup.h"

#include <bit>
#include <cstdint>

namespace kerf {

namespace {

std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
        h ^= std::bit_cast<std::uint64_t>(p[i] + 0.0);  // -0 + 0 = 0
        h *= 0x9e3779b97f4a7c15ULL;
        h ^= h >> 32;
    }
    return h;
}

// The first vertex with equal coordinates, for each vertex; by open addressing in the order of the vertices.
std::vector<std::int32_t> find_representatives(const std::vector<Vec3>& vertices) {
    const std::size_t mask = std::bit_ceil(2 * vertices.size() + 1) - 1;
    std::vector<std::int32_t> table(mask + 1, -1);
    std::vector<std::int32_t> representative(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        representative[v] = static_cast<std::int32_t>(v);
        if (vertices[v].hasNaN()) continue;  // equal to nothing; many of them would only lengthen the probes
        std::size_t slot = hash(vertices[v]) & mask;
        while (table[slot] >= 0 && vertices[table[slot]] != vertices[v]) slot = (slot + 1) & mask;
        if (table[slot] < 0) table[slot] = static_cast<std::int32_t>(v);
        representative[v] = table[slot];
    }
    return representative;
}

// Keeps the vertices that stand for themselves. representative[v]: v itself, an earlier vertex that replaces it, or -1
// for a vertex that no facet uses. Returns the number removed.
std::int64_t renumber(Soup& soup, std::vector<std::int32_t> representative) {
    std::vector<std::int32_t>& new_number = representative;
    std::int32_t kept = 0;
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
        if (new_number[v] == static_cast<std::int32_t>(v)) {
            soup.vertices[kept] = soup.vertices[v];
            new_number[v] = kept++;
        } else if (new_number[v] >= 0) {
            new_number[v] = new_number[new_number[v]];  // an earlier vertex, whose new number is known
        }
    }
    const auto removed = static_cast<std::int64_t>(soup.vertices.size()) - kept;
    soup.vertices.resize(kept);
    for (Triangle& t : soup.facets)
        for (std::int32_t& v : t) v = new_number[v];
    return removed;
}

}  // namespace

std::int64_t weld_exactly(Soup& soup) { return renumber(soup, find_representatives(soup.vertices)); }

std::int64_t drop_unused_vertices(Soup& soup) {
    std::vector<std::int32_t> representative(soup.vertices.size(), -1);
    for (const Triangle& t : soup.facets)
        for (std::int32_t v : t) representative[v] = v;
    return renumber(soup, std::move(representative));
}

}  // namespace kerf
