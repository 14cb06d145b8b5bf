// Solids inside of which a size is wanted.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// A box. Each solid knows the distance of a point from it, 0 inside, and the edge length `size` > 0 wanted inside.
struct SizedBox {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< opposite corners, low <= high
    double size = 1;

    double distance(const Vec3& p) const { return (low - p).cwiseMax(p - high).cwiseMax(0).norm(); }

    template <class Archive>
    void archive(Archive& a) {
        a(low, high, size);
    }
};

struct SizedSphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
    double size = 1;

    double distance(const Vec3& p) const { return std::max(0.0, (p - centre).norm() - radius); }

    template <class Archive>
    void archive(Archive& a) {
        a(centre, radius, size);
    }
};

/// A right circular cylinder with flat ends.
struct SizedCylinder {
    Vec3 from = Vec3::Zero(), to = Vec3::UnitX();  ///< centres of the ends, which differ
    double radius = 0;
    double size = 1;

    double distance(const Vec3& p) const {
        const double length = (to - from).norm();
        const Vec3 axis = (to - from) / length;
        const double along = axis.dot(p - from);
        const double beyond_end = std::max({0.0, -along, along - length});
        const double beyond_side = std::max(0.0, (p - from - along * axis).norm() - radius);
        return std::hypot(beyond_end, beyond_side);
    }

    template <class Archive>
    void archive(Archive& a) {
        a(from, to, radius, size);
    }
};

}  // namespace kerf
