// Forces at what is held, by who holds it and by the region whose cells take them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Sums for each support and region. A node on a wall has cells of several regions, and each counts what its own cells
/// do: the sum over the regions is that of the support.
class HeldForces {
 public:
    HeldForces() = default;
    HeldForces(std::size_t supports, std::size_t regions) : supports_(supports), sums_(3 * supports * regions, 0) {}

    void add(std::size_t support, std::size_t region, std::size_t component, double force) {
        sums_[3 * (supports_ * region + support) + component] += force;
    }
    Vec3 of(std::size_t support, std::size_t region) const {
        return Eigen::Map<const Vec3>(&sums_[3 * (supports_ * region + support)]);
    }
    /// Over all regions.
    Vec3 of(std::size_t support) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t region = 0; region < regions(); ++region) sum += of(support, region);
        return sum;
    }
    /// Of the same supports and regions.
    HeldForces& operator-=(const HeldForces& other) {
        for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] -= other.sums_[i];
        return *this;
    }
    std::size_t supports() const { return supports_; }
    std::size_t regions() const { return supports_ ? sums_.size() / (3 * supports_) : 0; }
    std::span<double> numbers() { return sums_; }

 private:
    std::size_t supports_ = 0;
    std::vector<double> sums_;
};

}  // namespace kerf
