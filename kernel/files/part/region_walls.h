// The walls between regions, and the patches that bound them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/part/part.h"

namespace kerf {

/// The two sides of walls, and the patches of each region. They do not depend on the parts: a facet of the input has
/// the same regions on its sides everywhere. Empty where the mesh has one region.
class RegionWalls {
 public:
    /// Reads the surfaces of all parts, which lie in one region each. Memory: 40 bytes for each facet of the input on a
    /// wall. Throws Error(io).
    explicit RegionWalls(const PartSource& parts);

    /// Tells for a boundary triangle that is_wall() whether its part lies in that of the two regions with the smaller
    /// number. Part::is_listed() takes the side of either part, from one triangle to the next.
    bool is_first(const Part& part, std::size_t f) const;
    /// Returns the region on the other side of a boundary triangle that is_wall().
    RegionIndex beyond(const Part& part, std::size_t f) const;

    /// Returns the regions that have a wall with this one; ascending.
    const std::vector<RegionIndex>& neighbours(RegionIndex region) const { return neighbours_[region]; }
    /// Returns the patches that have triangles of this region with nothing on their other side; ascending.
    const std::vector<std::int32_t>& outer_patches(RegionIndex region) const { return outer_patches_[region]; }

 private:
    std::unordered_map<std::int32_t, std::pair<RegionIndex, RegionIndex>> sides_at_;  // by facet; smaller one first
    Array<RegionIndex, std::vector<RegionIndex>> neighbours_;
    Array<RegionIndex, std::vector<std::int32_t>> outer_patches_;
};

/// Returns the region on the inner side of a boundary triangle; for a surface without tetrahedra its only one.
RegionIndex region_behind(const Part& part, std::size_t f);

}  // namespace kerf
