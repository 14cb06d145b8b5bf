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
    explicit RegionSizes(Array<RegionIndex, double> max_volumes) : max_volumes_(std::move(max_volumes)) {}

    bool empty() const { return max_volumes_.empty(); }
    const Array<RegionIndex, double>& max_volumes() const { return max_volumes_; }
    /// Returns the field of a region; `all` is that of regions without a size of their own.
    SizeField of(RegionIndex region, const SizeField& all) const {
        const bool has_own = region.is_valid() && region < RegionIndex(max_volumes_.size()) && max_volumes_[region] > 0;
        return has_own ? all.with_constant(max_volumes_[region]) : all;
    }

 private:
    Array<RegionIndex, double> max_volumes_;
};

}  // namespace kerf
