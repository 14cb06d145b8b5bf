// The angles are those by which cut/cut/inside/acceptance.h judges an interface.
#include "viewer/model/interface_places.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/core/ids.h"
#include "base/geometry/angles.h"

namespace kerf::view {

namespace {

InterfacePlace place_of(double angle_deg, const std::array<Vec3, 3>& p) {
    InterfacePlace place{.angle_deg = angle_deg, .where = (p[0] + p[1] + p[2]) / 3, .radius = 0};
    for (const Vec3& corner : p) place.radius = std::max(place.radius, (corner - place.where).norm());
    return place;
}

std::array<Vec3, 3> corners_of(const std::vector<Vec3>& points, const Triangle& t) {
    return {points[t[0]], points[t[1]], points[t[2]]};
}

}  // namespace

std::optional<InterfacePlace> smallest_angle(const Interface& interface) {
    std::optional<InterfacePlace> worst;
    for (const Triangle& t : interface.triangles) {
        const std::array<Vec3, 3> p = corners_of(interface.points, t);
        for (std::size_t i = 0; i < 3; ++i) {
            const double angle = angle_degrees(p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
            if (!worst || angle < worst->angle_deg) worst = place_of(angle, p);
        }
    }
    return worst;
}

std::optional<InterfacePlace> smallest_dihedral(const Interface& interface, const NodeSurface& parent) {
    // Edges between contour vertices, of which those of the surface are found again.
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::array<Vec3, 3>>> at_edge;
    const std::int32_t count = count_of(interface.contour);
    for (const Triangle& t : interface.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            if (a >= count || b >= count) continue;
            const auto [low, high] = std::minmax(interface.contour[a], interface.contour[b]);
            at_edge[{low.value(), high.value()}].push_back(corners_of(interface.points, {a, b, t[(i + 2) % 3]}));
        }
    std::optional<InterfacePlace> worst;
    for (const Triangle& facet : parent.facets)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(facet[i], facet[(i + 1) % 3]);
            const auto found = at_edge.find({low, high});
            if (found == at_edge.end()) continue;
            const Vec3& apex = parent.vertices[facet[(i + 2) % 3]];
            for (const std::array<Vec3, 3>& p : found->second) {
                const double angle = dihedral_degrees(p[0], p[1], p[2], apex);
                if (!worst || angle < worst->angle_deg) worst = place_of(angle, p);
            }
        }
    return worst;
}

}  // namespace kerf::view
