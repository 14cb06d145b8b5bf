// Facets that lie on one another up to roundings: pairs of them, and groups that are divided together.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "surface/arrange/inside/crossing_pairs.h"
#include "surface/arrange/inside/divided_facets.h"

namespace kerf {

/// Returns all pairs of facets that lie in one plane within `tolerance` and share area, and of which one is near,
/// ascending. `is_near` (#F): facets of these pairs become near, too, and so on. Expected O(#F log #F).
std::vector<FacetPair> plane_overlaps(const DividedFacets& divided, std::vector<char>& is_near, double tolerance,
                                      const std::function<void()>& check_cancelled);

struct PlaneGroups {
    std::vector<std::int32_t> facets;  ///< numbers of facets, group after group
    std::vector<std::size_t> first;    ///< the place of each group in `facets`, and the end
    std::vector<std::int32_t> of;      ///< #F: the group of each facet; -1: none

    std::size_t count() const { return first.size() - 1; }
};

/// Groups the `chosen` facets (ascending): the two of an overlapping pair, and copies, come into one group, as far as
/// all are within a small multiple of `tolerance` of the plane of its largest facet. O(n log n) for groups in one
/// plane.
PlaneGroups group_planes(const DividedFacets& divided, std::span<const std::int32_t> chosen,
                         std::span<const FacetPair> overlaps, double tolerance);

}  // namespace kerf
