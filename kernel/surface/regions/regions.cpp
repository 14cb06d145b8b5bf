#include "surface/regions/regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {}  // namespace

std::int32_t make_feature_patches(Soup& soup, double angle_deg) {
    const std::vector<std::int32_t> partner = edge_partners(soup.facets);
    std::vector<Vec3> normal;
    normal.reserve(soup.facets.size());
    for (const Triangle& t : soup.facets) normal.push_back(area_vector(soup.vertices, t).normalized());
    const double limit = angle_deg * std::numbers::pi / 180;
    UnionFind facets(soup.facets.size());
    for (std::int32_t corner = 0; corner < count_of(partner); ++corner) {
        const std::int32_t f = corner / 3, other = partner[corner] / 3;
        if (partner[corner] >= 0 && !(angle_between(normal[f], normal[other]) > limit)) facets.join(f, other);
    }
    Components regions = facets.take();
    soup.patch = std::move(regions.of);
    soup.patch_names.clear();
    for (std::int32_t number = 1; number <= regions.count; ++number)
        soup.patch_names.push_back("face_" + std::to_string(number));
    return count_of(soup.patch_names);
}

std::int64_t keep_largest_component(Soup& soup) {
    UnionFind vertices(soup.vertices.size());
    for (const Triangle& t : soup.facets)
        for (const std::int32_t v : t) vertices.join(t[0], v);
    std::vector<double> area(soup.vertices.size(), 0);
    for (const Triangle& t : soup.facets) {
        const double own = area_vector(soup.vertices, t).norm();
        if (std::isfinite(own)) area[vertices.root(t[0])] += own;
    }
    const std::int32_t largest = std::max_element(area.begin(), area.end()) - area.begin();
    std::vector<char> drop;
    for (const Triangle& t : soup.facets) drop.push_back(vertices.root(t[0]) != largest);
    drop_facets(soup, drop);
    return std::count(drop.begin(), drop.end(), char{1});
}

}  // namespace kerf
