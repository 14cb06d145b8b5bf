// The places where an interface is worst, by its angles and by its angles to the surface.
#pragma once

#include <optional>

#include "viewer/model/document.h"

namespace kerf::view {

/// A place of an interface and the angle there.
struct InterfacePlace {
    double angle_deg = 180;
    Vec3 where = Vec3::Zero();
    double radius = 0;  ///< radius of the triangle that is there
};

/// Returns the place of the smallest angle of the triangles of an interface; none if it has no triangles.
/// O(#triangles).
std::optional<InterfacePlace> smallest_angle(const Interface& interface);

/// Returns the place on its contour where an interface meets the surface that it cuts at the smallest angle; none if it
/// has no contour. `parent` is that surface, with the vertex numbers of the cut. O(#F).
std::optional<InterfacePlace> smallest_dihedral(const Interface& interface, const NodeSurface& parent);

}  // namespace kerf::view
