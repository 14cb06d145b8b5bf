// The polygon is scaled to the size 1 with its first corner at the origin. n is its unit normal by Newell's sum of the
// cross products of consecutive corners, s_1, s_2, ... are the spokes from an apex to the other corners in their order.
//
// The fan is the polygon if every triangle has the orientation of n, s_(i-1) x s_i . n > 0, and no spoke lies behind
// the first, s_1 x s_i . n >= 0: then the spokes turn one way through less than a full circle.
#include "files/io/inside/polygon_fan.h"

#include <algorithm>

#include "base/core/check.h"
#include "surface/soup/scaled_polygon.h"

namespace kerf {

namespace {

constexpr double smallest_sine = 1e-6;      // between a spoke and the rim; less is a corner on a straight side
constexpr double largest_turn_back = 1e-3;  // sine; of a last spoke that should be opposite to the first
constexpr std::size_t most_tried = 32;      // corners as apex, so that long polygons cost no squares

bool fan_is_polygon(const ScaledPolygon& polygon, const Vec3& normal, std::size_t apex) {
    const auto spoke = [&](std::size_t i) -> Vec3 { return polygon.corner(apex + i) - polygon.corner(apex); };
    const Vec3 first = spoke(1);
    Vec3 previous = first;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Vec3 next = spoke(i);
        const double limit = smallest_sine * previous.norm() * (next - previous).norm();
        if (!(previous.cross(next).dot(normal) > limit)) return false;
        if (first.cross(next).dot(normal) < -largest_turn_back * first.norm() * next.norm()) return false;
        previous = next;
    }
    return true;
}

}  // namespace

PolygonFan find_fan(const std::vector<Vec3>& vertices, std::span<const std::int64_t> corners) {
    KERF_CHECK(corners.size() >= 4);
    const ScaledPolygon polygon(vertices, corners);
    if (!polygon.is_finite()) return {};
    const Vec3 normal = polygon.has_size() ? newell_sum(polygon).stableNormalized() : Vec3(Vec3::Zero());
    if (normal.isZero()) return {0, "has no area"};
    if (!PlaneHeights(polygon, normal).is_flat(polygon)) return {0, "is not planar"};
    for (std::size_t apex = 0; apex < std::min(polygon.size(), most_tried); ++apex)
        if (fan_is_polygon(polygon, normal, apex)) return {apex, nullptr};
    return {0, "is not convex or has corners on several of its sides"};
}

}  // namespace kerf
