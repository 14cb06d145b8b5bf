// An order of items along a curve that fills space, so that items near each other in it are near each other in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/core/threads.h"

namespace kerf {

/// An item and its place on the curve.
struct MortonItem {
    std::uint64_t code = 0;
    std::int32_t item = 0;
};

/// Returns the place of a point of the unit cube on Morton's curve through 2^63 cells; points outside count as on its
/// border.
inline std::uint64_t morton_code(const std::array<float, 3>& point) {
    constexpr float most = (1 << 21) - 1;
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        auto bits = static_cast<std::uint64_t>(std::clamp(point[axis] * most, 0.0F, most));
        bits = (bits | bits << 32) & 0x001f00000000ffff;
        bits = (bits | bits << 16) & 0x001f0000ff0000ff;
        bits = (bits | bits << 8) & 0x100f00f00f00f00f;
        bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
        bits = (bits | bits << 2) & 0x1249249249249249;
        code |= bits << axis;
    }
    return code;
}

/// Sorts by code, then by item; items of one code must be ascending before. Expected O(n), on threads; takes memory for
/// a copy of the items.
void sort_by_code(std::vector<MortonItem>& items);

/// Returns the numbers below `count` in the order of the codes of `point_of(i)`, equal ones ascending. O(count), on
/// threads, with the same result for any number of them; takes 32 bytes a number meanwhile.
template <class PointOf>
std::vector<std::int32_t> morton_order(std::size_t count, const PointOf& point_of) {
    constexpr std::size_t grain = 1 << 14;
    std::vector<MortonItem> items(count);
    for_ranges_on_threads(count, grain, [&](const IndexRange& range) {
        for (std::size_t i = range.first; i < range.last; ++i)
            items[i] = {morton_code(point_of(i)), static_cast<std::int32_t>(i)};
    });
    sort_by_code(items);
    std::vector<std::int32_t> order(count);
    for_ranges_on_threads(count, grain, [&](const IndexRange& range) {
        for (std::size_t i = range.first; i < range.last; ++i) order[i] = items[i].item;
    });
    return order;
}

}  // namespace kerf
