#include "viewer/model/repaired_places.h"

#include <algorithm>
#include <cmath>

#include "base/core/ids.h"

namespace kerf::view {

std::vector<std::int32_t> facets_of_file(const Soup& soup, const std::vector<std::int32_t>& faces) {
    std::vector<std::int32_t> facets;
    const std::int32_t count = count_of(soup.facets);
    for (const std::int32_t face : faces) {
        if (soup.polygon.empty()) {
            if (face >= 0 && face < count) facets.push_back(face);
            continue;
        }
        const auto [first, last] = std::equal_range(soup.polygon.begin(), soup.polygon.end(), face);
        for (auto f = first; f != last; ++f) facets.push_back(static_cast<std::int32_t>(f - soup.polygon.begin()));
    }
    return facets;
}

double radius_around(const Soup& soup, const std::vector<std::int32_t>& facets, const Vec3& place, double diagonal) {
    double radius = 0;
    for (const std::int32_t facet : facets)
        for (const std::int32_t vertex : soup.facets[facet]) {
            const double distance = (soup.vertices[vertex] - place).norm();
            if (std::isfinite(distance)) radius = std::max(radius, distance);
        }
    return radius > 0 ? std::clamp(1.5 * radius, 1e-3 * diagonal, 0.5 * diagonal) : 0.02 * diagonal;
}

}  // namespace kerf::view
