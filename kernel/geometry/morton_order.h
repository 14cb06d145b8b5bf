// Items in the order of a curve that fills space, so that those near each other in it are near each other in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/threads.h"

namespace kerf {

/// An item and where it is on the curve.
struct MortonItem {
    std::uint64_t code = 0;
    std::int32_t item = 0;
};

/// Where a point of the unit cube is on Morton's curve through 2^63 cells; what is outside counts as on its border.
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

/// Sorts by code, and equal ones by number: those of a code must be ascending. Expected O(n), on threads; memory for a
/// copy of the items.
void sort_by_code(std::vector<MortonItem>& items);

/// The numbers below `count` in the order of the codes of `point_of(i)`, equal ones ascending. O(count), on threads, of
/// which the result does not depend; 32 bytes a number meanwhile.
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
