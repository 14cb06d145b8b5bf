// Polygons in space, scaled so that their size and place do not matter.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// A polygon scaled to the size 1 with its first corner at the origin. Keeps references to its arguments; `corners` are
/// indices into `vertices`, at least one.
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
    /// Largest difference of a coordinate from that of the first corner, in units of the vertices.
    double scale() const { return scale_; }
    bool has_size() const { return scale_ > 0; }
    bool is_finite() const {
        return std::all_of(corners_.begin(), corners_.end(), [&](auto v) { return vertices_[v].allFinite(); });
    }
    /// The rounding of the coordinates of a corner, scaled; most programs write six digits.
    double rounding() const {
        constexpr double relative_rounding = 1e-5;
        return relative_rounding * largest_ / scale_;
    }
    /// Corner i, scaled; i is counted on beyond the last corner.
    Vec3 corner(std::size_t i) const { return (vertex(i % size()) - vertex(0)) / scale_; }

 private:
    const Vec3& vertex(std::size_t i) const { return vertices_[corners_[i]]; }

    const std::vector<Vec3>& vertices_;
    std::span<const std::int64_t> corners_;
    double largest_ = 0, scale_ = 0;
};

/// Newell's sum of the cross products of consecutive corners: a vector along the normal, twice the area in length.
inline Vec3 newell_sum(const ScaledPolygon& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) sum += polygon.corner(i).cross(polygon.corner(i + 1));
    return sum;
}

/// The lowest and the highest corner, measured from the plane through the first one. `normal` has unit length.
struct PlaneHeights {
    std::size_t lowest = 0, highest = 0;  ///< indices of corners
    double low = 0, high = 0;             ///< scaled

    PlaneHeights(const ScaledPolygon& polygon, const Vec3& normal) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const double height = polygon.corner(i).dot(normal);
            if (height < low) lowest = i;
            if (height > high) highest = i;
            low = std::min(low, height);
            high = std::max(high, height);
        }
    }
    /// Whether the corners lie in the plane up to rounding.
    bool is_flat(const ScaledPolygon& polygon) const { return high - low <= 2 * polygon.rounding(); }
};

}  // namespace kerf
