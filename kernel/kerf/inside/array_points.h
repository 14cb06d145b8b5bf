// Points of the facade's arrays as those of the kernel.
#pragma once

#include <array>
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

}  // namespace kerf
