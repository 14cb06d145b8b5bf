// The regions on the two sides of a facet.
#pragma once

#include <compare>

#include "base/core/ids.h"

namespace kerf {

/// The two regions that a facet separates; none: the outside of all regions.
struct FacetSides {
    RegionIndex front = RegionIndex::none();  ///< where its normal points to
    RegionIndex back;

    bool is_wall() const { return front.is_valid() && back.is_valid(); }
    FacetSides turned() const { return {back, front}; }
    auto operator<=>(const FacetSides&) const = default;

    template <class Archive>
    void archive(Archive& a) {
        a(front, back);
    }
};

}  // namespace kerf
