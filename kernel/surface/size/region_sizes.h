// The sizes of regions that have sizes of their own.
#pragma once

#include <utility>
#include <vector>

#include "base/core/ids.h"
#include "surface/size/size_field.h"

namespace kerf {

/// The sizes wanted in some regions, in place of that wanted everywhere. Sources that make sizes smaller at places do
/// so in these regions, too.
class RegionSizes {
 public:
    RegionSizes() = default;
    /// `max_volumes` has the largest volume of a tetrahedron in each region, as for SizeField; 0: as everywhere.
    explicit RegionSizes(std::vector<double> max_volumes) : max_volumes_(std::move(max_volumes)) {}

    bool empty() const { return max_volumes_.empty(); }
    const std::vector<double>& max_volumes() const { return max_volumes_; }
    /// Returns the field of a region; `all` is that of regions without a size of their own.
    SizeField of(RegionIndex region, const SizeField& all) const {
        const auto r = static_cast<std::size_t>(region.value());
        return r < max_volumes_.size() && max_volumes_[r] > 0 ? all.with_constant(max_volumes_[r]) : all;
    }

 private:
    std::vector<double> max_volumes_;
};

}  // namespace kerf
