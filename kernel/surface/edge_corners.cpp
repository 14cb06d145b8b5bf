// A counting sort by the smaller end vertex; within such a bucket (six entries on average) those with the same larger
// end are at one edge. No hashing, so the order of edges, and with it everything that follows, depends on the input
// alone. Partners are found for a range of smaller ends at a time, in the blocks of facets that have such ends: files
// number vertices as facets come, so that each range has few blocks, and what is sorted stays in the cache.
#include "surface/edge_corners.h"

#include <algorithm>

#include "core/check.h"
#include "core/threads.h"

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
    if (end - begin > short_bucket) {
        std::stable_sort(begin, end, [](const auto& a, const auto& b) { return a.high < b.high; });
        return;
    }
    for (auto it = begin; it != end; ++it) {
        const EdgeCorners::Corner corner = *it;
        auto place = it;
        for (; place != begin && corner.high < (place - 1)->high; --place) *place = *(place - 1);
        *place = corner;
    }
}

// The partners of all corners, those at edges whose smaller ends are in one range by one thread.
class PartnerSearch {
 public:
    explicit PartnerSearch(const std::vector<Triangle>& facets)
        : facets_(facets), blocks_(values_of_ranges(facets.size(), facets_of_block, [&](const IndexRange& range) {
              return smaller_ends(range);
          })) {}

    std::vector<std::int32_t> run() {
        partner_.assign(3 * facets_.size(), -1);
        std::size_t vertex_count = 0;
        for (const Ends& ends : blocks_) vertex_count = std::max(vertex_count, ends.last + 1);
        for_ranges_on_threads(vertex_count, grain(vertex_count), [&](const IndexRange& range) { pair_at(range); });
        return std::move(partner_);
    }

 private:
    static constexpr std::size_t facets_of_block = 4096, least_grain = 1 << 15;

    // Between which vertices the smaller ends of the edges of a block lie.
    struct Ends {
        std::size_t first = 0, last = 0;

        bool meet(const IndexRange& range) const { return first < range.last && last >= range.first; }
    };
    struct Entry {
        std::int32_t low, high, corner;
    };

    Ends smaller_ends(const IndexRange& range) const {
        std::int32_t first = facets_[range.first][0], last = 0;
        for (std::size_t f = range.first; f < range.last; ++f) {
            const auto& [a, b, c] = facets_[f];
            first = std::min({first, a, b, c});
            last = std::max({last, std::min(a, b), std::min(b, c), std::min(c, a)});
        }
        return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
    }
    // So many vertices of a range that blocks are read four times at most, wherever their vertices are.
    std::size_t grain(std::size_t vertex_count) const {
        std::size_t grain = least_grain;
        for (; grain < vertex_count; grain *= 2) {
            std::size_t visits = 0;
            for (const Ends& ends : blocks_) visits += ends.last / grain - ends.first / grain + 1;
            if (visits <= 4 * blocks_.size()) break;
        }
        return grain;
    }
    std::vector<Entry> entries_at(const IndexRange& range) const {
        const auto first = static_cast<std::int32_t>(range.first), last = static_cast<std::int32_t>(range.last);
        std::vector<Entry> entries;
        entries.reserve(7 * (range.last - range.first));  // six of a closed surface
        for (std::size_t block = 0; block < blocks_.size(); ++block) {
            if (!blocks_[block].meet(range)) continue;
            const std::size_t end = std::min(facets_.size(), (block + 1) * facets_of_block);
            for (std::size_t f = block * facets_of_block; f < end; ++f)
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto [low, high] = std::minmax(facets_[f][i], facets_[f][i == 2 ? 0 : i + 1]);
                    if (low >= first && low < last)
                        entries.push_back({low - first, high, static_cast<std::int32_t>(3 * f + i)});
                }
        }
        return entries;
    }
    void pair_at(const IndexRange& range) {
        const std::vector<Entry> entries = entries_at(range);
        std::vector<std::int32_t> end(range.last - range.first + 1, 0);
        for (const Entry& entry : entries) ++end[entry.low + 1];
        for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
        std::vector<EdgeCorners::Corner> corners(entries.size());
        for (const Entry& entry : entries) corners[end[entry.low]++] = {entry.high, entry.corner};
        auto begin = corners.begin();
        for (std::size_t v = 0; v + 1 < end.size(); ++v) {
            const auto bucket_end = corners.begin() + end[v];
            sort_bucket(begin, bucket_end);
            pair_equal(begin, bucket_end);
            begin = bucket_end;
        }
    }
    void pair_equal(CornerIterator begin, CornerIterator end) {
        for (auto next = begin; begin != end; begin = next) {
            while (next != end && next->high == begin->high) ++next;
            if (next - begin != 2) continue;
            partner_[begin->corner] = (begin + 1)->corner;
            partner_[(begin + 1)->corner] = begin->corner;
        }
    }

    const std::vector<Triangle>& facets_;
    std::vector<Ends> blocks_;
    std::vector<std::int32_t> partner_;
};

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

std::vector<std::int32_t> edge_partners(const std::vector<Triangle>& facets) { return PartnerSearch(facets).run(); }

}  // namespace kerf
