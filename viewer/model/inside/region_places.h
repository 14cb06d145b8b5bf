// The places of regions, where there are several, and their moves when they are pulled apart.
#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "run/run/trace.h"
#include "viewer/model/tree.h"

namespace kerf::view {

/// The place of a region among the others.
struct RegionPlace {
    Eigen::AlignedBox3d box;
    /// The region around this one, or none: more than half of this one's facets are walls with it, and its box is
    /// larger and contains this one's.
    RegionIndex holder = RegionIndex::none();
};

/// Returns the places of the regions of a trace, by their numbers. O(#F log #regions).
Array<RegionIndex, RegionPlace> region_places(const Trace& trace);
/// Returns the places of the `count` regions of a run folder, for which the surfaces of its parts are read. Throws
/// Error(io).
Array<RegionIndex, RegionPlace> region_places(const std::string& folder, const Tree& tree, std::size_t count);

/// Returns the move of each region when all are pulled apart as far as they are large, in coordinates of the file. A
/// region without a holder moves away from the middle of all, so that bodies side by side stay so. A region with a
/// holder moves with that, and farther by the holder's length through the holder's nearest side. O(n).
Array<RegionIndex, Vec3> moves_apart(const Array<RegionIndex, RegionPlace>& places);

}  // namespace kerf::view
