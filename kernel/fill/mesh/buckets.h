// Sorting of faces or edges of many cells by their vertices, without all of them in memory at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace kerf {

/// Calls visit(bucket, std::span<Item>) for each of `bucket_count` buckets in order, with its items, which it may
/// change, in the order in which they come.
///
/// `for_each_item(take)` calls take(bucket, item) for all items, the same ones in the same order each time that it is
/// called: once to count, then once for as many buckets as hold `most_items` together, or for a single one that holds
/// more. Memory: those items, and 8 bytes a bucket. With few items that is one call to fill all buckets.
template <class Item, class ForEachItem, class Visit>
void visit_buckets(std::size_t bucket_count, std::size_t most_items, const ForEachItem& for_each_item,
                   const Visit& visit) {
    std::vector<std::size_t> end(bucket_count + 1, 0);  // end of the bucket before, among all items
    for_each_item([&](std::size_t bucket, const Item&) { ++end[bucket + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Item> items;
    items.reserve(std::min(end.back(), most_items));  // a vector that grows needs its old room beside the new one
    for (std::size_t first = 0; first < bucket_count;) {
        const std::size_t begin = end[first];
        const auto beyond = std::upper_bound(end.begin() + first + 2, end.end(), begin + most_items);
        const std::size_t last = beyond - end.begin() - 1;
        items.resize(end[last] - begin);
        // end[bucket] runs from the beginning of the bucket to its end, which is the beginning of the next one.
        for_each_item([&](std::size_t bucket, const Item& item) {
            if (bucket - first < last - first) items[end[bucket]++ - begin] = item;
        });
        for (std::size_t bucket = first, at = 0; bucket < last; ++bucket) {
            const std::size_t stop = end[bucket] - begin;
            visit(bucket, std::span(items).subspan(at, stop - at));
            at = stop;
        }
        first = last;
    }
}

}  // namespace kerf
