// Volume, area and the inertia of the vertex cloud.
#pragma once

#include "surface/complex/surface.h"

namespace kerf {

struct MassProperties {
    double volume = 0;             ///< enclosed, by the divergence theorem; positive if normals point out
    double volume_error = 0;       ///< bound on the rounding error of `volume`, see bounded_volume()
    double area = 0;               ///< of all facets
    Vec3 centroid = Vec3::Zero();  ///< of the vertices, each of unit mass
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< of the vertices about the centroid, each of unit mass
    Vec3 eigenvalues = Vec3::Zero();                    ///< of the inertia, ascending
    Eigen::Matrix3d axes =
        Eigen::Matrix3d::Identity();  ///< columns: unit eigenvectors, in the order of the eigenvalues
};

/// Computes the mass properties of a surface. Axis 0 belongs to the smallest moment: the long direction of the body.
/// Ties are broken without regard to rounding: in an eigenspace of nearly equal moments (1e-3 relative), and within
/// 1e-3 rad, coordinate axes are preferred; the largest component of every axis is positive. O(#V + #F).
MassProperties mass_properties(const Surface& surface);

/// Returns the volume inside of a closed set of facets. Sums relative to the first corner of the first facet, so that
/// cancellation grows with the distance from there and `vertices` may be those of a larger surface.
double enclosed_volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

double enclosed_volume(const Surface& surface);

struct BoundedVolume {
    double value = 0;
    double error = 0;  ///< the exact volume, for the coordinates as they are, differs from `value` by no more
};

/// Returns the volume with a bound on its rounding error, which is found beside the sum. There are two sources of
/// error. Differences from the first corner are rounded by e = 2^-53 of themselves, which moves the vertices of a
/// surface that is still closed, and so changes the volume by less than the sum of area x distance x e. And the n
/// products are rounded and added with 64 bits, which errs by less than (n + 8) 2^-64 times the sum of their absolute
/// values. Twice the time of enclosed_volume().
BoundedVolume bounded_volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Whether the normals of a shell, a connected closed set of facets, point out of it; those of a void point into it.
/// Right for a shell of any size, wherever it lies among others.
bool is_outward(const std::vector<Vec3>& vertices, const std::vector<Triangle>& shell);

}  // namespace kerf
