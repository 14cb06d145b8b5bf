// Sides of facets, by the numbers of regions.
#pragma once

#include <cstdint>

#include "surface/soup/facet_sides.h"

namespace kerf::test {

/// -1 is the outside.
constexpr FacetSides facet_sides(std::int32_t front, std::int32_t back) {
    return {RegionIndex(front), RegionIndex(back)};
}

}  // namespace kerf::test
