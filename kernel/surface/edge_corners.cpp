// A counting sort by the smaller end vertex; within such a bucket (six entries on average) those with the same larger
// end are at one edge. No hashing, so the order of edges, and with it everything that follows, depends on the input
// alone.
#include "surface/edge_corners.h"

#include <algorithm>

#include "core/check.h"

namespace kerf {

namespace {

constexpr std::ptrdiff_t short_bucket = 16;

// Calls visit(corner, smaller end vertex, larger end vertex) for the corners without a partner, ascending.
template <class Visit>
void for_each_open_corner(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner, Visit visit) {
    for (std::size_t c = 0; c < 3 * facets.size(); ++c) {
        if (!partner.empty() && partner[c] >= 0) continue;
        const Triangle& t = facets[c / 3];
        const auto [low, high] = std::minmax(t[c % 3], t[(c + 1) % 3]);
        visit(static_cast<std::int32_t>(c), low, high);
    }
}

std::size_t vertex_count_of(const std::vector<Triangle>& facets) {
    std::int32_t largest = -1;
    for (const Triangle& t : facets) largest = std::max({largest, t[0], t[1], t[2]});
    return static_cast<std::size_t>(largest) + 1;
}

using CornerIterator = std::vector<EdgeCorners::Corner>::iterator;

// Corners arrive in ascending order, so a stable sort by the larger end suffices.
void sort_bucket(CornerIterator begin, CornerIterator end) {
    const auto less = [](const EdgeCorners::Corner& a, const EdgeCorners::Corner& b) { return a.high < b.high; };
    if (end - begin > short_bucket) {
        std::stable_sort(begin, end, less);
        return;
    }
    for (auto it = begin; it != end; ++it) std::rotate(std::upper_bound(begin, it, *it, less), it, it + 1);
}

}  // namespace

EdgeCorners::EdgeCorners(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner)
    : first_(vertex_count_of(facets) + 1, 0) {
    KERF_CHECK(partner.empty() || partner.size() == 3 * facets.size());
    for_each_open_corner(facets, partner, [&](std::int32_t, std::int32_t low, std::int32_t) { ++first_[low + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];

    corners_.resize(first_.back());
    std::vector<std::int32_t> end(first_.begin(), first_.end() - 1);
    for_each_open_corner(facets, partner, [&](std::int32_t corner, std::int32_t low, std::int32_t high) {
        corners_[end[low]++] = {high, corner};
    });
    for (std::size_t v = 0; v + 1 < first_.size(); ++v)
        sort_bucket(corners_.begin() + first_[v], corners_.begin() + first_[v + 1]);
}

bool has_edge_of_many(const std::vector<Triangle>& facets) {
    bool is_found = false;
    EdgeCorners(facets).for_each_edge(
        [&](std::int32_t, std::span<const EdgeCorners::Corner> corners) { is_found |= corners.size() > 2; });
    return is_found;
}

std::vector<std::int32_t> edge_partners(const std::vector<Triangle>& facets) {
    std::vector<std::int32_t> partner(3 * facets.size(), -1);
    EdgeCorners(facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() != 2) return;
        partner[corners[0].corner] = corners[1].corner;
        partner[corners[1].corner] = corners[0].corner;
    });
    return partner;
}

}  // namespace kerf
