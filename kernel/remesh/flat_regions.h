// The flat pieces of a surface.
#pragma once

#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

/// A piece of a surface of which all vertices lie within `tolerance` of a plane.
struct FlatRegion {
    Vec3 normal;    ///< of length 1, out of the body
    double offset;  ///< normal.dot(x) in the plane
    double tolerance;

    double height(const Vec3& p) const { return normal.dot(p) - offset; }
    bool contains(const Vec3& p) const { return std::abs(height(p)) <= tolerance; }
};

struct FlatRegions {
    std::vector<std::int32_t> of;  ///< #F
    std::vector<FlatRegion> planes;
};

struct FlatRegionOptions {
    double tolerance = 0;
    double noise = 0;                                  ///< height of a facet below which its normal says nothing
    std::function<bool(std::int32_t)> is_border = {};  ///< of a corner: whether a region ends at its edge
};

/// Grows regions over edges of two facets, from the largest facets to the smallest; every facet belongs to one.
/// O(#F log #F), deterministic.
FlatRegions find_flat_regions(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                              const FlatRegionOptions& options);

}  // namespace kerf
