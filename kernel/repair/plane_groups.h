// Facets that are divided together, because they lie on one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "repair/crossing_pairs.h"
#include "repair/divided_facets.h"

namespace kerf {

struct PlaneGroups {
    std::vector<std::int32_t> facets;  ///< group after group
    std::vector<std::size_t> first;    ///< of each group in `facets`, and the end
    std::vector<std::int32_t> of;      ///< #F: the group of a facet; -1: not among these

    std::size_t count() const { return first.size() - 1; }
};

/// Groups of the `chosen` facets (ascending): those of an overlapping pair, and copies, come into one, as far as all
/// are within a small multiple of `tolerance` of the plane of the largest. O(n log n) for groups in one plane.
PlaneGroups group_planes(const DividedFacets& divided, std::span<const std::int32_t> chosen,
                         std::span<const FacetPair> overlaps, double tolerance);

}  // namespace kerf
