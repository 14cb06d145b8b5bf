// The motions of a body as a whole.
#pragma once

#include <Eigen/Core>

#include "base/core/types.h"

namespace kerf {

/// The rigid motions of a body, and those of them that supports and springs leave. A motion has six numbers:
/// translation, then rotation about `middle` in radians times `scale`.
struct BodyMotions {
    Vec3 middle = Vec3::Zero();
    double scale = 1;      ///< the largest distance of a node from `middle`
    Eigen::MatrixXd free;  ///< 6 rows; orthonormal columns, at most 6: the motions that nothing prevents

    /// Returns the displacement of a point for each of the six motions, a column each.
    Eigen::Matrix<double, 3, 6> at(const Vec3& point) const;
};

}  // namespace kerf
