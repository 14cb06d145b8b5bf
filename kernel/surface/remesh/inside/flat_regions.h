// The flat pieces of a surface.
#pragma once

#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// A piece of a surface that lies near a plane; facets that replace its own must stay within `tolerance` of the plane.
struct FlatRegion {
    Vec3 normal;    ///< unit length, out of the body
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
    /// The largest distance of a facet's vertices from the plane of its region; the region has that of its first facet.
    std::function<double(std::int32_t)> tolerance;
    double noise = 0;                                  ///< height of a facet below which its normal is noise
    std::function<bool(std::int32_t)> is_border = {};  ///< whether a region ends at the edge of a corner
};

/// Grows regions over edges of two facets, from the largest facets to the smallest; every facet belongs to one.
/// O(#F log #F), deterministic.
FlatRegions find_flat_regions(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                              const FlatRegionOptions& options);

}  // namespace kerf
