// What regions have in common, and what bounds them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "part/part.h"

namespace kerf {

/// The two sides of walls, and the patches of each region, whatever parts there are: a facet of the input has the same
/// regions on its sides everywhere. Empty where the mesh has one region.
class RegionWalls {
 public:
    /// Reads the surfaces of all parts, which lie in one region each. Memory: 40 bytes for each facet of the input on a
    /// wall. Throws Error(io).
    explicit RegionWalls(const PartSource& parts);

    /// Of a boundary triangle that is_wall(): does its own part lie in that of the two regions with the smaller number?
    /// Part::is_listed() takes the side of either part, from one triangle to the next.
    bool is_first(const Part& part, std::size_t f) const;
    /// The region on the other side of a boundary triangle that is_wall().
    RegionIndex beyond(const Part& part, std::size_t f) const;

    /// The regions that have a wall with this one; ascending.
    const std::vector<RegionIndex>& neighbours(RegionIndex region) const { return neighbours_[region]; }
    /// The patches that have triangles of this region with nothing on their other side; ascending.
    const std::vector<std::int32_t>& outer_patches(RegionIndex region) const { return outer_patches_[region]; }

 private:
    std::unordered_map<std::int32_t, std::pair<RegionIndex, RegionIndex>> sides_at_;  // by facet; the first is smaller
    Array<RegionIndex, std::vector<RegionIndex>> neighbours_;
    Array<RegionIndex, std::vector<std::int32_t>> outer_patches_;
};

/// The region on the inner side of a boundary triangle; of a surface without tetrahedra the only one.
RegionIndex region_behind(const Part& part, std::size_t f);

}  // namespace kerf
