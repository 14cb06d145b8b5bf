// The regions on the two sides of a facet.
#pragma once

#include <cstdint>

namespace kerf {

/// The numbers of the two regions that a facet separates; -1: outside of all regions.
struct FacetSides {
    std::int32_t front = -1;  ///< where its normal points to
    std::int32_t back = 0;

    bool is_wall() const { return front >= 0 && back >= 0; }
    FacetSides turned() const { return {back, front}; }
    bool operator==(const FacetSides&) const = default;

    template <class Archive>
    void archive(Archive& a) {
        a(front, back);
    }
};

}  // namespace kerf
