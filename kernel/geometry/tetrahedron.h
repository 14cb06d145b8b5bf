// Volumes of tetrahedra, to the precision of doubles. Where only the sign counts, orientation() has it exactly.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "core/types.h"

namespace kerf {

/// det[b-a, c-a, d-a]: six times the volume, positive for every Tetrahedron (core/types.h).
inline double six_volumes_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
}
inline double six_volumes_of(const std::vector<Vec3>& vertices, const Tetrahedron& tet) {
    return six_volumes_of(vertices[tet[0]], vertices[tet[1]], vertices[tet[2]], vertices[tet[3]]);
}

}  // namespace kerf
