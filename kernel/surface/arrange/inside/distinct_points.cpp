#include "surface/arrange/inside/distinct_points.h"

namespace kerf {

DistinctPoints::DistinctPoints(std::vector<Vec3> points) : points_(std::move(points)), table_(points_.size()) {
    for (std::size_t i = 0; i < points_.size(); ++i)
        table_.enter(static_cast<std::int32_t>(i), hash_of_point(points_[i]), points_);
}

std::int32_t DistinctPoints::number_of(const Vec3& p) {
    const auto next = static_cast<std::int32_t>(points_.size());
    points_.push_back(p);
    const std::int32_t number = table_.enter(next, hash_of_point(p), points_);
    if (number != next) points_.pop_back();
    return number;
}

}  // namespace kerf
