// Boxes along the coordinate axes, around points and around elements.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// A box along the axes, empty when it is constructed.
using Box = Eigen::AlignedBox3d;

/// Returns the smallest box around all points of a range.
template <class Points>
Box box_around(const Points& points) {
    Box box;
    for (const Vec3& p : points) box.extend(p);
    return box;
}

/// Returns the smallest box around those points that have no infinite or undefined coordinate.
inline Box box_around_finite(const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3& p : points)
        if (p.allFinite()) box.extend(p);
    return box;
}

/// Returns the smallest box around the corners of one facet or tetrahedron.
template <std::size_t corners>
Box box_around(const std::vector<Vec3>& vertices, const std::array<std::int32_t, corners>& element) {
    Box box;
    for (const std::int32_t v : element) box.extend(vertices[v]);
    return box;
}

/// Returns the boxes of facets or tetrahedra, in their order.
template <std::size_t corners>
std::vector<Box> boxes_around(const std::vector<Vec3>& vertices,
                              const std::vector<std::array<std::int32_t, corners>>& elements) {
    std::vector<Box> boxes;
    boxes.reserve(elements.size());
    for (const auto& element : elements) boxes.push_back(box_around(vertices, element));
    return boxes;
}

}  // namespace kerf
