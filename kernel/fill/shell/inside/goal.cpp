#include "fill/shell/inside/goal.h"

#include <algorithm>

#include "base/geometry/predicates.h"

namespace kerf {

namespace {

bool is_corner(const Triangle& triangle, std::int32_t v) {
    return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
}

// Whether an edge goes through a triangle's inside or through an edge of it, and has ends on both sides of its plane.
bool crosses(const SpatialTriangulation& t, std::int32_t u, std::int32_t v, const Triangle& triangle) {
    if (is_corner(triangle, u) || is_corner(triangle, v)) return false;
    const auto& p = t.points();
    const auto& [a, b, c] = triangle;
    const int from = orientation(p[a], p[b], p[c], p[u]), to = orientation(p[a], p[b], p[c], p[v]);
    if (from * to >= 0) return false;
    const int x = orientation(p[u], p[v], p[a], p[b]), y = orientation(p[u], p[v], p[b], p[c]);
    if (x * y < 0) return false;
    const int z = orientation(p[u], p[v], p[c], p[a]);
    return x * z >= 0 && y * z >= 0;
}

}  // namespace

bool Goal::allows_face(const SpatialTriangulation& triangulation, const Triangle& face) const {
    if (!is_edge() || std::min({face[0], face[1], face[2]}) < 0) return true;
    return !crosses(triangulation, corners_[0], corners_[1], face);
}

bool Goal::allows_edge(const SpatialTriangulation& triangulation, std::int32_t p, std::int32_t q) const {
    if (count_ != 3 || std::min(p, q) < 0) return true;
    return !crosses(triangulation, p, q, corners_);
}

}  // namespace kerf
