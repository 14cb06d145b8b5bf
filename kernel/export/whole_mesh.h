// All parts as one mesh, without ever holding more than one of them.
#pragma once

#include <functional>
#include <span>

#include "part/part.h"

namespace kerf {

/// Calls take(first, points) with the vertices of the whole mesh in the order of their global numbers: a piece at a
/// time, the first of which has the number `first`. Parts are loaded as often as pieces need them.
void for_each_vertex(const PartSource& parts,
                     const std::function<void(std::int64_t first, std::span<const Vec3> points)>& take);

/// Calls take(rank, part) with every part, in the order of the tree.
void for_each_part(const PartSource& parts, const std::function<void(std::int32_t rank, const Part& part)>& take);

/// Corners of a cell of the part as global numbers.
template <std::size_t n>
std::array<std::int64_t, n> global_corners(const Part& part, const std::array<std::int32_t, n>& cell) {
    std::array<std::int64_t, n> ids;
    for (std::size_t i = 0; i < n; ++i) ids[i] = part.global_id[static_cast<std::size_t>(cell[i])];
    return ids;
}

}  // namespace kerf
