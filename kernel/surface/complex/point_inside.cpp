// Rays of the largest facets are taken, since those of small ones may end at the facet beside.
#include "surface/complex/point_inside.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

Vec3 point_inside(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    constexpr std::int32_t most_rays = 16;
    constexpr double longest = std::numeric_limits<double>::infinity();
    std::vector<double> area;
    for (const Triangle& t : facets) area.push_back(area_vector(vertices, t).norm());
    std::vector<std::int32_t> order(facets.size());
    std::iota(order.begin(), order.end(), 0);
    const std::int32_t rays = std::min(most_rays, count_of(order));
    std::partial_sort(order.begin(), order.begin() + rays, order.end(),
                      [&](std::int32_t a, std::int32_t b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
    const TriangleTree tree(vertices, facets);
    Vec3 best = Vec3::Zero();
    double longest_ray = -1;
    for (std::int32_t i = 0; i < rays; ++i) {
        const Triangle& t = facets[order[i]];
        const Vec3 from = (vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3;
        const Vec3 inwards = -area_vector(vertices, t).normalized();
        const double length =
            tree.first_hit(from, inwards, 0, longest, [&](std::int32_t facet) { return facet != order[i]; });
        if (length == longest || !(length > longest_ray)) continue;
        longest_ray = length;
        best = from + length / 2 * inwards;
    }
    return best;
}

}  // namespace kerf
