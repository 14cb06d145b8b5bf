#include "surface/regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "surface/edge_partners.h"

namespace kerf {

namespace {

Vec3 area_vector(const Soup& soup, const Triangle& t) {
    const Vec3& a = soup.vertices[t[0]];
    return (soup.vertices[t[1]] - a).cross(soup.vertices[t[2]] - a) / 2;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

std::int32_t make_feature_patches(Soup& soup, double angle_deg) {
    const std::vector<std::int32_t> partner = edge_partners(soup.facets);
    std::vector<Vec3> normal;
    normal.reserve(soup.facets.size());
    for (const Triangle& t : soup.facets) normal.push_back(area_vector(soup, t).normalized());
    const double limit = angle_deg * std::numbers::pi / 180;
    soup.patch.assign(soup.facets.size(), -1);
    soup.patch_names.clear();
    std::vector<std::int32_t> region;
    for (std::size_t seed = 0; seed < soup.facets.size(); ++seed) {
        if (soup.patch[seed] >= 0) continue;
        const auto patch = static_cast<std::int32_t>(soup.patch_names.size());
        soup.patch_names.push_back("face_" + std::to_string(patch));
        soup.patch[seed] = patch;
        region.assign(1, static_cast<std::int32_t>(seed));
        while (!region.empty()) {
            const std::int32_t f = region.back();
            region.pop_back();
            for (std::int32_t corner = 3 * f; corner < 3 * f + 3; ++corner) {
                const std::int32_t other = partner[corner] < 0 ? -1 : partner[corner] / 3;
                if (other < 0 || soup.patch[other] >= 0 || angle_between(normal[f], normal[other]) > limit) continue;
                soup.patch[other] = patch;
                region.push_back(other);
            }
        }
    }
    return static_cast<std::int32_t>(soup.patch_names.size());
}

std::int64_t keep_largest_component(Soup& soup) {
    std::vector<std::int32_t> parent(soup.vertices.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const Triangle& t : soup.facets)
        for (const std::int32_t v : t) {
            const auto [low, high] = std::minmax({root(t[0]), root(v)});
            parent[high] = low;
        }
    std::vector<double> area(soup.vertices.size(), 0);
    for (const Triangle& t : soup.facets) {
        const double own = area_vector(soup, t).norm();
        if (std::isfinite(own)) area[root(t[0])] += own;
    }
    const auto largest = static_cast<std::int32_t>(std::max_element(area.begin(), area.end()) - area.begin());
    std::vector<char> drop;
    for (const Triangle& t : soup.facets) drop.push_back(root(t[0]) != largest);
    drop_facets(soup, drop);
    return std::count(drop.begin(), drop.end(), char{1});
}

}  // namespace kerf
