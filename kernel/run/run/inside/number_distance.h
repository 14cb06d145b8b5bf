// The distance between two numbers, for files whose numbers are not what they should be.
#pragma once

#include <algorithm>
#include <cstdint>

namespace kerf {

/// Returns |a - b|, at most 2^40: files may have any numbers, and counts of wrong ones are added up.
inline std::int64_t number_distance(std::int64_t a, std::int64_t b) {
    constexpr std::uint64_t most = std::uint64_t{1} << 40;
    const std::uint64_t low = std::min(a, b), high = std::max(a, b);
    return std::min(most, high - low);
}

}  // namespace kerf
