// The directions along which a symmetric matrix only stretches.
#pragma once

#include <Eigen/Core>

#include "core/types.h"

namespace kerf {

/// Eigenvalues, ascending, and unit eigenvectors: a column each.
struct SymmetricAxes {
    Vec3 values;
    Eigen::Matrix3d vectors;
};

/// Of a symmetric matrix; what is above its diagonal is not read. Deterministic, but of equal eigenvalues rounding
/// chooses the vectors.
SymmetricAxes symmetric_axes(const Eigen::Matrix3d& matrix);

}  // namespace kerf
