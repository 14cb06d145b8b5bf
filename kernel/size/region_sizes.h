// Sizes of regions that have one of their own.
#pragma once

#include <utility>
#include <vector>

#include "core/ids.h"
#include "size/size_field.h"

namespace kerf {

/// What is wanted in some regions in place of what is wanted everywhere. What makes sizes smaller at places does so in
/// them, too.
class RegionSizes {
 public:
    RegionSizes() = default;
    /// The largest volume of a tetrahedron in each region, as SizeField has it; 0: as everywhere.
    explicit RegionSizes(std::vector<double> max_volumes) : max_volumes_(std::move(max_volumes)) {}

    bool empty() const { return max_volumes_.empty(); }
    const std::vector<double>& max_volumes() const { return max_volumes_; }
    /// The field of a region, where `all` is that of the others.
    SizeField of(RegionIndex region, const SizeField& all) const {
        const auto r = static_cast<std::size_t>(region.value());
        return r < max_volumes_.size() && max_volumes_[r] > 0 ? all.with_constant(max_volumes_[r]) : all;
    }

 private:
    std::vector<double> max_volumes_;
};

}  // namespace kerf
