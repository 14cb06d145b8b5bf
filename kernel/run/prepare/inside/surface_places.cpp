#include "run/prepare/inside/surface_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry/triangle.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double sharp_angle_deg = 30;  // as RemeshOptions::feature_angle_deg

// Whether two facets meet at a sharp angle; facets of a wall may be turned either way.
bool meet_sharply(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b, bool is_opposite) {
    const Vec3 na = area_vector(points, a), nb = area_vector(points, b);
    const double cosine = (is_opposite ? 1 : -1) * na.dot(nb);
    return !(cosine > std::cos(sharp_angle_deg * std::numbers::pi / 180) * na.norm() * nb.norm());
}

}  // namespace

PlacedSurface::PlacedSurface(const SurfaceArrays& arrays) : patch(arrays.patch) {
    std::int32_t count = 0;
    for (const Key key : arrays.vertex_key) count = std::max(count, key_index(key) + 1);
    points.resize(count);
    for (std::size_t v = 0; v < arrays.vertices.size(); ++v)
        points[key_index(arrays.vertex_key[v])] = arrays.vertices[v];
    facets.reserve(arrays.facets.size());
    for (const auto& [a, b, c] : arrays.facets)
        facets.push_back(
            {key_index(arrays.vertex_key[a]), key_index(arrays.vertex_key[b]), key_index(arrays.vertex_key[c])});
    edges.reserve(facets.size() * 3 / 2);
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        PlacedEdge& edge = edges.emplace_back();
        edge.ends = {low, corners.front().high};
        for (const auto& [high, corner] : corners) edge.patches.push_back(patch[corner / 3]);
        std::sort(edge.patches.begin(), edge.patches.end());
        edge.patches.erase(std::unique(edge.patches.begin(), edge.patches.end()), edge.patches.end());
        edge.is_border = corners.size() != 2 || edge.patches.size() > 1;
        const auto is_upwards = [&](std::size_t i) { return start_vertex(facets, corners[i].corner) == low; };
        edge.is_sharp = edge.is_border || meet_sharply(points, facets[corners[0].corner / 3],
                                                       facets[corners[1].corner / 3], is_upwards(0) != is_upwards(1));
    });
}

}  // namespace kerf
