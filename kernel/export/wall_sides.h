// The sides of walls between regions.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "part/part.h"

namespace kerf {

/// Which side of a wall is which, whatever parts there are: a facet of the input has the same two regions everywhere.
/// Part::is_listed() takes the side of either part, from one triangle to the next.
class WallSides {
 public:
    /// Reads the surfaces of all parts, where there are several regions. Memory: 40 bytes for each facet of the input
    /// on a wall. Throws Error(io).
    explicit WallSides(const PartSource& parts);

    /// Of a boundary triangle that is_wall(): does its own part lie in that of the two regions with the smaller number?
    bool is_first(const Part& part, std::size_t f) const;

 private:
    std::unordered_map<std::int32_t, RegionIndex> first_at_;  // by facet
};

/// The region on the inner side of a boundary triangle; of a surface without tetrahedra the only one.
RegionIndex region_behind(const Part& part, std::size_t f);

}  // namespace kerf
