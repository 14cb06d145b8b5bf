// Where an interface is worst.
#pragma once

#include <optional>

#include "viewer/model/document.h"

namespace kerf::view {

struct InterfacePlace {
    double angle_deg = 180;
    Vec3 where = Vec3::Zero();
    double radius = 0;  ///< of the triangle that is there
};

/// Where triangles of an interface have their smallest angle; none if it has no triangles. O(#triangles).
std::optional<InterfacePlace> smallest_angle(const Interface& interface);

/// Where an interface meets the surface that it cuts at the smallest angle, along its contour; none if it has no
/// contour. `parent`: with the vertex numbers of the cut. O(#F).
std::optional<InterfacePlace> smallest_dihedral(const Interface& interface, const NodeSurface& parent);

}  // namespace kerf::view
