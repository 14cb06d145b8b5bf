// Centroid and inertia of a body of uniform density.
#pragma once

#include "surface/complex/complex.h"
#include "surface/complex/inside/principal_axes.h"

namespace kerf {

struct SolidProperties {
    double volume = 0;                                  ///< of all regions
    Vec3 centroid = Vec3::Zero();                       ///< of the volume
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centroid, with a density of 1
    PrincipalAxes principal;                            ///< of the inertia
};

/// Returns the properties of all regions together, by the divergence theorem: sums over facets, relative to the first
/// vertex. O(#F).
SolidProperties solid_properties(const Complex& complex);

}  // namespace kerf
