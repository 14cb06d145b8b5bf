// Eigenvectors of a symmetric matrix.
#pragma once

#include <Eigen/Core>

#include "base/core/types.h"

namespace kerf {

/// The eigenvalues of a matrix, ascending, and its unit eigenvectors as columns.
struct SymmetricAxes {
    Vec3 values;
    Eigen::Matrix3d vectors;
};

/// Returns the axes of a symmetric matrix; entries above its diagonal are not read. Deterministic, but among equal
/// eigenvalues rounding chooses the vectors.
SymmetricAxes symmetric_axes(const Eigen::Matrix3d& matrix);

}  // namespace kerf
