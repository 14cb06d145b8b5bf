// Faces by the numbers or keys of their corners.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "base/core/types.h"

namespace kerf::test {

/// The corners in order, the smallest first: equal triples are the same face seen from the same side.
using Face = std::array<std::int64_t, 3>;

inline Face rotated(Face f) {
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f;
}
/// The same face seen from behind.
inline Face turned(const Face& f) { return {f[0], f[2], f[1]}; }

inline bool same_bits(const Vec3& a, const Vec3& b) { return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0; }

}  // namespace kerf::test
