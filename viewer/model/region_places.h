// Where the regions of several are, and where they go when they are pulled apart.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "run/trace.h"
#include "viewer/model/tree.h"

namespace kerf::view {

struct RegionPlace {
    Eigen::AlignedBox3d box;
    /// The region that is around it: most of its facets are walls with that one, whose box holds its own. -1: none.
    std::int32_t holder = -1;
};

/// By the numbers of regions. O(#F log #regions).
std::vector<RegionPlace> region_places(const Trace& trace);
/// The same of the parts of a run folder with `count` regions, whose surfaces are read. Throws Error(io).
std::vector<RegionPlace> region_places(const std::string& folder, const Tree& tree, std::size_t count);

/// How far each region moves where they are as far apart as they are large: away from the middle of all, so that
/// bodies side by side stay so; a region that is held moves with its holder, and on, to where least of that is in the
/// way, by the holder's length. Coordinates of the file. O(n).
std::vector<Vec3> moves_apart(const std::vector<RegionPlace>& places);

}  // namespace kerf::view
