// How near to a line a facet's corners lie.
#pragma once

#include <algorithm>
#include <vector>

#include "base/geometry/triangle.h"

namespace kerf::test {

/// The height over the longest edge, in units of that edge: of needles nearly 0.
inline double relative_height(const std::vector<Vec3>& vertices, const Triangle& t) {
    const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    return doubled_area_vector(a, b, c).norm() /
           std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

/// Of all facets the smallest.
inline double least_relative_height(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    double least = 1;
    for (const Triangle& t : facets) least = std::min(least, relative_height(vertices, t));
    return least;
}

}  // namespace kerf::test
