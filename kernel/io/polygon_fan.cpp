// The polygon is scaled to the size 1 with its first corner at the origin. n is its unit normal by Newell's sum of the
// cross products of consecutive corners, s_1, s_2, ... are the spokes from an apex to the other corners in their order.
//
// The fan is the polygon if every triangle has the orientation of n, s_(i-1) x s_i . n > 0, and no spoke lies behind
// the first, s_1 x s_i . n >= 0: then the spokes turn one way through less than a full circle.
#include "io/polygon_fan.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/check.h"

namespace kerf {

namespace {

constexpr double smallest_sine = 1e-6;      // between a spoke and the rim; less is a corner on a straight side
constexpr double relative_rounding = 1e-5;  // of coordinates
constexpr double largest_turn_back = 1e-3;  // sine; of a last spoke that should be opposite to the first
constexpr std::size_t most_tried = 32;      // corners as apex, so that long polygons cost no squares

// A polygon scaled to size 1.
class ScaledPolygon {
 public:
    ScaledPolygon(const std::vector<Vec3>& vertices, std::span<const std::int64_t> corners)
        : vertices_(vertices), corners_(corners) {
        for (std::size_t i = 0; i < size(); ++i) {
            largest_ = std::max(largest_, vertex(i).cwiseAbs().maxCoeff());
            scale_ = std::max(scale_, (vertex(i) - vertex(0)).cwiseAbs().maxCoeff());
        }
    }
    std::size_t size() const { return corners_.size(); }
    bool has_size() const { return scale_ > 0; }
    bool is_finite() const {
        return std::all_of(corners_.begin(), corners_.end(), [&](auto v) { return vertices_[v].allFinite(); });
    }
    double rounding() const { return relative_rounding * largest_ / scale_; }
    /// Corner i, counted on over the last.
    Vec3 corner(std::size_t i) const { return (vertex(i % size()) - vertex(0)) / scale_; }

 private:
    const Vec3& vertex(std::size_t i) const { return vertices_[corners_[i]]; }

    const std::vector<Vec3>& vertices_;
    std::span<const std::int64_t> corners_;
    double largest_ = 0, scale_ = 0;
};

Vec3 newell_normal(const ScaledPolygon& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) sum += polygon.corner(i).cross(polygon.corner(i + 1));
    return sum.stableNormalized();
}

bool is_planar(const ScaledPolygon& polygon, const Vec3& normal) {
    double low = 0, high = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const double height = polygon.corner(i).dot(normal);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    return high - low <= 2 * polygon.rounding();
}

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
    const Vec3 normal = polygon.has_size() ? newell_normal(polygon) : Vec3(Vec3::Zero());
    if (normal.isZero()) return {0, "has no area"};
    if (!is_planar(polygon, normal)) return {0, "is not planar"};
    for (std::size_t apex = 0; apex < std::min(polygon.size(), most_tried); ++apex)
        if (fan_is_polygon(polygon, normal, apex)) return {apex, nullptr};
    return {0, "is not convex or has corners on several of its sides"};
}

}  // namespace kerf
