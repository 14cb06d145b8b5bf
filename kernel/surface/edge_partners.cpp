// Edges by sorting: every facet contributes its three edges as (smaller end, larger end, corner); equal ends lie side
// by side, and those that occur twice join two facets.
#include "surface/edge_partners.h"

#include <algorithm>
#include <tuple>

namespace kerf {

namespace {

// Edge `corner % 3` of facet `corner / 3`, from that vertex to the next.
struct EdgeOfCorner {
    std::int32_t low, high, corner;
    bool same_ends(const EdgeOfCorner& other) const { return low == other.low && high == other.high; }
};

}  // namespace

std::vector<std::int32_t> edge_partners(const std::vector<Triangle>& facets) {
    std::vector<EdgeOfCorner> edges;
    edges.reserve(3 * facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f)
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(facets[f][i], facets[f][(i + 1) % 3]);
            edges.push_back({low, high, static_cast<std::int32_t>(3 * f + i)});
        }
    std::sort(edges.begin(), edges.end(), [](const EdgeOfCorner& a, const EdgeOfCorner& b) {
        return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });
    std::vector<std::int32_t> partner(edges.size(), -1);
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        while (j < edges.size() && edges[j].same_ends(edges[i])) ++j;
        if (j - i != 2) continue;
        partner[edges[i].corner] = edges[i + 1].corner;
        partner[edges[i + 1].corner] = edges[i].corner;
    }
    return partner;
}

}  // namespace kerf
