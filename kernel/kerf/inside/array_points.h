// Points and cells of the facade's arrays as those of the kernel.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/core/types.h"

namespace kerf {

inline std::vector<Vec3> to_points(std::span<const std::array<double, 3>> vertices) {
    std::vector<Vec3> points;
    points.reserve(vertices.size());
    for (const auto& [x, y, z] : vertices) points.emplace_back(x, y, z);
    return points;
}

/// Returns the corners of a cell in the 32 bits in which the kernel counts.
template <std::size_t N>
std::array<std::int32_t, N> narrowed(const std::array<std::int64_t, N>& corners) {
    std::array<std::int32_t, N> narrow;
    for (std::size_t i = 0; i < N; ++i) narrow[i] = corners[i];
    return narrow;
}

}  // namespace kerf
