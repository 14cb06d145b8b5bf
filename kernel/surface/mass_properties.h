// Volume, area and the inertia of the vertex cloud.
#pragma once

#include "surface/surface.h"

namespace kerf {

struct MassProperties {
    double volume = 0;             ///< enclosed, by the divergence theorem; positive when normals point out
    double area = 0;               ///< of all facets
    Vec3 centroid = Vec3::Zero();  ///< of the vertices, unit mass each
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< of the vertices about the centroid, unit mass each
    Vec3 eigenvalues = Vec3::Zero();                    ///< of the inertia, ascending
    Eigen::Matrix3d axes =
        Eigen::Matrix3d::Identity();  ///< columns: unit eigenvectors, in the order of the eigenvalues
};

/// Axis 0 belongs to the smallest moment: the long direction of the body. Ties are broken without regard to rounding:
/// in an eigenspace of nearly equal moments (1e-3 relative), and within 1e-3 rad, coordinate axes are preferred; the
/// largest component of every axis is positive. O(#V + #F).
MassProperties mass_properties(const Surface& surface);

/// Enclosed volume of a closed set of facets. Summed relative to the first corner of the first facet: cancellation
/// grows with the distance from there, and the vertices may be those of a larger surface.
double enclosed_volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

double enclosed_volume(const Surface& surface);

/// Whether the normals of a shell, a connected closed set of facets, point out of it: those of a void point into it.
/// Right for a shell of any size, wherever it lies among the others.
bool is_outward(const std::vector<Vec3>& vertices, const std::vector<Triangle>& shell);

}  // namespace kerf
