// Triangles by three names of vertices that are the same in every part.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace kerf {

using NamedTriangle = std::array<std::int64_t, 3>;

/// Returns the triangle with the same orientation, its smallest vertex first: equal triangles compare equal.
inline NamedTriangle rotated_to_smallest(NamedTriangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

/// Returns the triangle with the opposite orientation; the first vertex stays.
inline NamedTriangle reversed(const NamedTriangle& t) { return {t[0], t[2], t[1]}; }

}  // namespace kerf
