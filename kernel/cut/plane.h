// Planes that a body may be cut by, in the order in which they are worth trying.
#pragma once

#include <optional>
#include <vector>

#include "cut/options.h"
#include "surface/mass_properties.h"

namespace kerf {

struct PlaneCandidate {
    Plane plane;
    std::int32_t axis = 0;  ///< rank of the direction, 0 first
    std::int32_t step = 0;  ///< along the direction, 0 at the bisection
    bool inside_load_window = true;
};

/// Directions of the normal for a criterion, best first: the principal axes, or the coordinate axes by falling extent.
/// The directions in which a cut may go; with a fixed axis there is only that one.
std::vector<Vec3> cut_directions(const Surface& surface, const MassProperties& mass, const CutOptions& options);

/// The planes across one direction: first the one that leaves `fraction` of the load (of the extent for equidistant
/// cuts) below, then steps to both sides. Steps are 0.6 crossing edges and grow by 15 % each. The surface, mass and
/// options must outlive it.
class PlaneSequence {
 public:
    /// O(1); the planes are made when they are asked for.
    PlaneSequence(const Surface& surface, const MassProperties& mass, const Vec3& direction, std::int32_t axis,
                  double fraction, const CutOptions& options)
        : surface_(surface),
          options_(options),
          through_centroid_(mass.centroid, direction),
          axis_(axis),
          fraction_(fraction) {}

    /// A plane that meets nothing, in the middle of a gap between bodies, with nearly that fraction of the load below:
    /// within the load window; of several the nearest. None for equidistant cuts. Gaps shorter than a thousandth of the
    /// extent are not found. O(#V + #F).
    std::optional<PlaneCandidate> between_bodies() const;

    /// The i-th plane, or none beyond the last. O(#V + #F) for the first and for the second, which makes all steps.
    const PlaneCandidate* at(std::size_t i);

 private:
    void add_bisection();
    void add_steps();

    const Surface& surface_;
    const CutOptions& options_;
    Plane through_centroid_;
    std::int32_t axis_;
    double fraction_;
    double middle_ = 0;  // height of the bisection
    std::vector<PlaneCandidate> candidates_;
};

}  // namespace kerf
