// Hands out the items on patches in the order of the patches, a limited number at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace kerf {

/// Calls visit(add), which calls add(item) with all items in some order, and then take(patch, items) with the items of
/// patch after patch, in that order within a patch; the items of a large patch come in several calls in a row. Item has
/// a member `patch`; `sizes`: number of items of each patch. Holds at most 2^20 items and 32 MB, and calls visit()
/// again where all items together are more.
template <class Item, class Visit, class Take>
void for_each_by_patch(std::span<const std::int64_t> sizes, const Visit& visit, Take&& take) {
    constexpr std::int64_t items_at_once =
        std::min(std::int64_t{1} << 20, (std::int64_t{1} << 25) / std::int64_t{sizeof(Item)});
    std::vector<Item> items;
    const auto take_all = [&] {
        std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.patch < b.patch; });
        for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
            while (end < items.size() && items[end].patch == items[begin].patch) ++end;
            take(items[begin].patch, std::span<const Item>(items).subspan(begin, end - begin));
        }
        items.clear();
    };
    std::size_t last = 0;
    for (std::size_t first = 0; first < sizes.size(); first = last) {
        // One patch, or several whose items are held together.
        std::int64_t together = sizes[first];
        for (last = first + 1; last < sizes.size() && together + sizes[last] <= items_at_once; ++last)
            together += sizes[last];
        visit([&](const Item& item) {
            const std::size_t patch = item.patch;
            if (patch < first || patch >= last) return;
            if (std::ssize(items) == items_at_once) take_all();
            items.push_back(item);
        });
        take_all();
    }
}

}  // namespace kerf
