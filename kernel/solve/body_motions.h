// The motions of a body as a whole.
#pragma once

#include <Eigen/Core>

#include "core/types.h"

namespace kerf {

/// Which motions of a body its supports and springs leave: translation, then rotation about `middle` in radians times
/// `scale`.
struct BodyMotions {
    Vec3 middle = Vec3::Zero();
    double scale = 1;      ///< the largest distance of a node from there
    Eigen::MatrixXd free;  ///< 6 rows; orthonormal columns that nothing prevents, 6 at most

    /// 3 x 6: the displacement of a point for each motion.
    Eigen::Matrix<double, 3, 6> at(const Vec3& point) const;
};

}  // namespace kerf
