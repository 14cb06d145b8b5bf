// Planes that a body may be cut by, in the order in which they are worth trying.
#pragma once

#include <vector>

#include "cut/options.h"
#include "surface/mass_properties.h"

namespace kerf {

struct PlaneCandidate {
    Plane plane;
    std::int32_t axis = 0;  ///< rank of the direction, 0 first
    std::int32_t step = 0;  ///< along the direction, 0 at the bisection
    bool inside_load_window = true;
};

/// Directions of the normal for a criterion, best first: the principal axes, or the coordinate axes by falling extent.
/// With a fixed axis there is only that one.
std::vector<Vec3> cut_directions(const Surface& surface, const MassProperties& mass, const CutOptions& options);

/// The plane that leaves `fraction` of the load (of the extent for equidistant cuts) below, then steps to both sides.
/// Steps are 0.6 crossing edges and grow by 15 % each. O(#V + #F) for the bisection and for every step.
std::vector<PlaneCandidate> plane_candidates(const Surface& surface, const MassProperties& mass, const Vec3& direction,
                                             std::int32_t axis, double fraction, const CutOptions& options);

}  // namespace kerf
