// The flat pieces of a surface.
#pragma once

#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

/// A piece of a surface that lies near a plane, and what may become of it stays within `tolerance` of that.
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
    /// How far the vertices of a facet may be from the plane of its region; that of the region is its first facet's.
    std::function<double(std::int32_t)> tolerance;
    double noise = 0;                                  ///< height of a facet below which its normal says nothing
    std::function<bool(std::int32_t)> is_border = {};  ///< of a corner: whether a region ends at its edge
};

/// Grows regions over edges of two facets, from the largest facets to the smallest; every facet belongs to one.
/// O(#F log #F), deterministic.
FlatRegions find_flat_regions(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                              const FlatRegionOptions& options);

}  // namespace kerf
