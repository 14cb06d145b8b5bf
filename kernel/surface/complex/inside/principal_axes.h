// The principal axes of a body, about which it turns freely.
#pragma once

#include <Eigen/Core>

#include "base/core/types.h"

namespace kerf {

struct PrincipalAxes {
    Vec3 moments = Vec3::Zero();  ///< eigenvalues of the inertia, ascending
    Eigen::Matrix3d axes =
        Eigen::Matrix3d::Identity();  ///< columns: unit eigenvectors, in the order of the eigenvalues
};

/// Returns the principal axes of a symmetric matrix. Axis 0 belongs to the smallest moment: the long direction of the
/// body. Ties are broken without regard to rounding: in an eigenspace of nearly equal moments (1e-3 relative), and
/// within 1e-3 rad, coordinate axes are preferred; the largest component of every axis is positive.
PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia);

}  // namespace kerf
