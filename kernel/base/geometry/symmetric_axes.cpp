#include "base/geometry/symmetric_axes.h"

#include <Eigen/Eigenvalues>

namespace kerf {

SymmetricAxes symmetric_axes(const Eigen::Matrix3d& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace kerf
