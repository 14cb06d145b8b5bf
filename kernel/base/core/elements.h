// Checks of arrays of facets and tetrahedra.
#pragma once

#include <algorithm>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Whether all corners are in [0, vertex_count). O(n).
template <std::size_t N>
bool are_in_range(const std::vector<std::array<std::int32_t, N>>& elements, std::size_t vertex_count) {
    return std::all_of(elements.begin(), elements.end(), [&](const auto& element) {
        return std::all_of(element.begin(), element.end(),
                           [&](std::int32_t v) { return v >= 0 && static_cast<std::size_t>(v) < vertex_count; });
    });
}

constexpr bool has_repeated_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Whether every facet has three different vertices. O(n).
inline bool have_distinct_corners(const std::vector<Triangle>& facets) {
    return std::none_of(facets.begin(), facets.end(), has_repeated_vertex);
}

}  // namespace kerf
