// A ray from the place is tried in one direction after the other.
#include "viewer/model/line_of_sight.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace kerf::view {

namespace {

constexpr double least_cosine = 0.5;  // 60 degrees: a surface that is seen more from the side is hard to read

// Returns the distance along the ray (Möller and Trumbore 1997, moeller1997), infinity if it passes by.
double distance_along(const Vec3& from, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double none = INFINITY;
    const Vec3 ab = b - a, ac = c - a, p = direction.cross(ac);
    const double volume = ab.dot(p);
    if (!(std::abs(volume) > 0)) return none;
    const Vec3 s = from - a;
    const double u = s.dot(p) / volume;
    if (!(u >= 0 && u <= 1)) return none;
    const Vec3 q = s.cross(ab);
    const double v = direction.dot(q) / volume;
    if (!(v >= 0 && u + v <= 1)) return none;
    return ac.dot(q) / volume;
}

class Place {
 public:
    Place(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Vec3& at, double near)
        : vertices_(vertices), facets_(facets), at_(at), near_(near) {}

    bool is_seen_from(const Vec3& direction) const {
        return std::none_of(facets_.begin(), facets_.end(), [&](const Triangle& t) {
            const double distance = distance_along(at_, direction, vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
            return distance > near_ && std::isfinite(distance);
        });
    }

 private:
    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const Vec3 at_;
    const double near_;
};

// The axis itself, then around it, ever more from the side.
std::vector<Vec3> directions_around(const Vec3& axis) {
    std::vector<Vec3> directions = {axis};
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    for (const double tilt : {0.4, 0.8})
        for (int i = 0; i < 6; ++i) {
            const double angle = i * M_PI / 3;
            directions.emplace_back(std::cos(tilt) * axis +
                                    std::sin(tilt) * (std::cos(angle) * u + std::sin(angle) * v));
        }
    return directions;
}

}  // namespace

Vec3 mean_normal(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                 const std::vector<std::int32_t>& chosen) {
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const std::int32_t f : chosen) {
        const Triangle& t = facets[f];
        const Vec3& a = vertices[t[0]];
        const Vec3 normal = (vertices[t[1]] - a).cross(vertices[t[2]] - a);
        if (!normal.allFinite()) continue;
        sum += normal;
        area += normal.norm();
    }
    return sum.norm() > 1e-6 * area ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

std::optional<Vec3> direction_to_eye(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                     const Vec3& where, double near, const Vec3& outward, const Vec3& present) {
    const Place place(vertices, facets, where, near);
    const bool is_known = outward.squaredNorm() > 0;
    if ((!is_known || std::abs(outward.dot(present)) >= least_cosine) && place.is_seen_from(present)) return present;
    std::vector<Vec3> tried = directions_around(is_known ? outward : present);
    for (const Vec3& inward : directions_around(is_known ? -outward : -present)) tried.push_back(inward);
    const auto found =
        std::find_if(tried.begin(), tried.end(), [&](const Vec3& direction) { return place.is_seen_from(direction); });
    return found == tried.end() ? std::nullopt : std::optional(*found);
}

}  // namespace kerf::view
