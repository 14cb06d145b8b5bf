// Forces at supports, by the support that holds and by the region whose cells take them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf {

/// A force, and its moment about a point that the context defines.
struct ForceAndMoment {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();

    ForceAndMoment& operator+=(const ForceAndMoment& other) {
        force += other.force;
        moment += other.moment;
        return *this;
    }
};

/// Sums of forces for each support, spring or inertia relief, and each region. A node on a wall has cells of several
/// regions, and each region counts the forces of its own cells: the sum over the regions is that of the support.
/// Moments are about a point of the support.
class HeldForces {
 public:
    HeldForces() = default;
    /// `places`: a point of each support.
    HeldForces(std::vector<Vec3> places, std::size_t regions)
        : places_(std::move(places)), sums_(6 * places_.size() * regions, 0) {}

    /// Adds a force that acts at the point `at`.
    void add(std::size_t support, std::size_t region, const Vec3& force, const Vec3& at) {
        double* sum = &sums_[6 * (supports() * region + support)];
        Eigen::Map<Vec3>{sum} += force;
        Eigen::Map<Vec3>{sum + 3} += (at - places_[support]).cross(force);
    }
    ForceAndMoment of(std::size_t support, std::size_t region) const {
        const double* sum = &sums_[6 * (supports() * region + support)];
        return {Eigen::Map<const Vec3>(sum), Eigen::Map<const Vec3>(sum + 3)};
    }
    /// Returns the sum over all regions.
    ForceAndMoment of(std::size_t support) const {
        ForceAndMoment sum;
        for (std::size_t region = 0; region < regions(); ++region) sum += of(support, region);
        return sum;
    }
    /// Adds the sums of `other`, which has the same supports and regions, times a factor.
    void add(double factor, const HeldForces& other) {
        for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += factor * other.sums_[i];
    }
    std::size_t supports() const { return places_.size(); }
    std::size_t regions() const { return places_.empty() ? 0 : sums_.size() / (6 * places_.size()); }
    std::span<double> numbers() { return sums_; }

 private:
    std::vector<Vec3> places_;
    std::vector<double> sums_;
};

}  // namespace kerf
