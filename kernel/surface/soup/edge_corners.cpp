// A counting sort by the smaller end vertex; within such a bucket (six entries on average) corners with the same larger
// end are at one edge. There is no hashing, so the order of edges, and all that follows from it, depends on the input
// alone. Partners are found for a range of smaller ends at a time, in the blocks of facets that have such ends: files
// number vertices as facets come, so that each range has few blocks, and the entries to be sorted stay in the cache.
#include "surface/soup/edge_corners.h"

#include <algorithm>
#include <cstdint>

#include "base/core/check.h"
#include "base/core/threads.h"

namespace kerf {

namespace {

constexpr std::ptrdiff_t short_bucket = 16;

// Calls visit(corner, smaller end vertex, larger end vertex) for the corners without a partner, ascending.
template <class Visit>
void for_each_open_corner(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner, Visit visit) {
    for (std::int32_t c = 0; c < 3 * count_of(facets); ++c) {
        if (!partner.empty() && partner[c] >= 0) continue;
        const Triangle& t = facets[c / 3];
        const auto [low, high] = std::minmax(t[c % 3], t[(c + 1) % 3]);
        visit(c, low, high);
    }
}

std::size_t vertex_count_of(const std::vector<Triangle>& facets) {
    constexpr std::size_t grain = std::size_t{1} << 16;
    const auto largest_of = [&](const IndexRange& range) {
        std::int32_t largest = -1;
        for (std::size_t f = range.first; f < range.last; ++f)
            largest = std::max({largest, facets[f][0], facets[f][1], facets[f][2]});
        return largest;
    };
    std::size_t count = 0;
    for (const std::int32_t largest : values_of_ranges(facets.size(), grain, largest_of))
        count = std::max(count, static_cast<std::size_t>(largest) + 1);
    return count;
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
        : facets_(facets), vertex_count_(vertex_count_of(facets)) {
        while (vertex_count_ > most_buckets << shift_) ++shift_;
        blocks_ = values_of_ranges(facets.size(), facets_of_block,
                                   [&](const IndexRange& range) { return buckets_of(range); });
    }

    std::vector<std::int32_t> run() {
        partner_.assign(3 * facets_.size(), -1);
        const std::size_t grain = buckets_at_once() << shift_;
        for_ranges_on_threads(vertex_count_, grain, [&](const IndexRange& range) { pair_at(range); });
        return std::move(partner_);
    }

 private:
    static constexpr std::size_t facets_of_block = 4096, most_buckets = 64;

    struct Entry {
        std::int32_t low, high, corner;
    };

    // A bit for each bucket of vertices in which smaller ends of the edges of a block lie.
    std::uint64_t buckets_of(const IndexRange& range) const {
        std::uint64_t buckets = 0;
        for (std::size_t f = range.first; f < range.last; ++f) {
            const auto& [a, b, c] = facets_[f];
            const std::int32_t least = std::min({a, b, c});
            const std::int32_t middle = std::max({std::min(a, b), std::min(b, c), std::min(c, a)});
            buckets |= std::uint64_t{1} << (least >> shift_) | std::uint64_t{1} << (middle >> shift_);
        }
        return buckets;
    }
    static bool has_bucket_of(std::uint64_t buckets, std::size_t first, std::size_t last) {
        const std::uint64_t from_first = buckets >> first;
        return (last - first == most_buckets ? from_first : from_first & ((std::uint64_t{1} << (last - first)) - 1)) !=
               0;
    }
    // Returns as many buckets as can be taken at once while blocks are read four times at most, wherever their vertices
    // are.
    std::size_t buckets_at_once() const {
        for (std::size_t count = 1; count < most_buckets / 4; count *= 2) {
            std::size_t visits = 0;
            for (const std::uint64_t buckets : blocks_)
                for (std::size_t first = 0; first < most_buckets; first += count)
                    visits += has_bucket_of(buckets, first, first + count);
            if (visits <= 4 * blocks_.size()) return count;
        }
        return most_buckets / 4;
    }
    std::vector<Entry> entries_at(const IndexRange& range) const {
        const std::int32_t first = range.first, last = range.last;
        const std::size_t first_bucket = range.first >> shift_, last_bucket = ((range.last - 1) >> shift_) + 1;
        std::vector<Entry> entries;
        entries.reserve(7 * (range.last - range.first));  // six of a closed surface
        for (std::size_t block = 0; block < blocks_.size(); ++block) {
            if (!has_bucket_of(blocks_[block], first_bucket, last_bucket)) continue;
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
    std::size_t vertex_count_;
    int shift_ = 12;  // a bucket is 2^shift_ vertices
    std::vector<std::uint64_t> blocks_;
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
