// Points that have numbers, each place once.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/types.h"
#include "surface/vertex_table.h"

namespace kerf {

/// Points by number, and numbers by coordinates. -0 equals 0.
class DistinctPoints {
 public:
    /// Points that are equal keep their numbers.
    explicit DistinctPoints(std::vector<Vec3> points);

    const std::vector<Vec3>& all() const { return points_; }
    std::vector<Vec3> take() { return std::move(points_); }

    /// The smallest number of a point with these coordinates, which gets one if there is none. Expected O(1).
    std::int32_t number_of(const Vec3& p);

 private:
    std::vector<Vec3> points_;
    VertexTable table_;
};

}  // namespace kerf
