// The largest value of a measure over all ranks, and its place.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "solve/space/fe_space.h"

namespace kerf {

/// The largest value of a measure and its place.
struct Extreme {
    double value = 0;
    Vec3 place = Vec3::Zero();
};

/// Finds the largest of the values that are told on any rank.
class LargestPlace {
 public:
    void tell(double value, const Vec3& place) {
        if (value > found_[0]) found_ = {value, place.x(), place.y(), place.z()};
    }
    /// Returns the largest value; of equal ones that of the first rank, and there the first told; nothing if none was
    /// told. Collective.
    std::optional<Extreme> of_all(MpiRanks& ranks) const;

 private:
    static constexpr double nothing = -std::numeric_limits<double>::infinity();
    std::array<double, 4> found_{nothing, 0, 0, 0};
};

/// Returns the largest displacement of all nodes. `displacement`: 3 for each local node. Collective; O(n).
Extreme largest_displacement(const FeSpace& space, const std::vector<double>& displacement);

}  // namespace kerf
