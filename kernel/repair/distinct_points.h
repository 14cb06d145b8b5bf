// Points that have numbers, each place once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.h"

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
    std::size_t slot_of(const Vec3& p) const;
    void make_room();

    std::vector<Vec3> points_;
    std::vector<std::int32_t> slots_;  // a hash table with open addressing; -1: free
    std::size_t used_ = 0;
};

}  // namespace kerf
