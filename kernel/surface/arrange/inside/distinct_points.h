// Numbered points, of which each place has one.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/core/types.h"
#include "surface/soup/vertex_table.h"

namespace kerf {

/// Points that are found by number and by coordinates. -0 equals 0.
class DistinctPoints {
 public:
    /// Takes points with their numbers; equal ones among them keep theirs.
    explicit DistinctPoints(std::vector<Vec3> points);

    const std::vector<Vec3>& all() const { return points_; }
    std::vector<Vec3> take() { return std::move(points_); }

    /// Returns the smallest number of a point with these coordinates, and adds the point if there is none. Expected
    /// O(1).
    std::int32_t number_of(const Vec3& p);

 private:
    std::vector<Vec3> points_;
    VertexTable table_;
};

}  // namespace kerf
