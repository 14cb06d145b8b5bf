// The planes by which a body may be cut, in the order in which they are worth trying.
#pragma once

#include <optional>
#include <vector>

#include "cut/cut/inside/options.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

struct PlaneCandidate {
    Plane plane;
    std::int32_t axis = 0;  ///< rank of the direction, 0 is tried first
    std::int32_t step = 0;  ///< along the direction, 0 at the bisection
    bool inside_load_window = true;
};

/// Returns the directions in which a cut may go, as normals of planes, best first: the principal axes for the inertia
/// criterion, else the coordinate axes by falling extent; only the fixed axis if there is one.
std::vector<Vec3> cut_directions(const Surface& surface, const MassProperties& mass, const CutOptions& options);

/// The planes across one direction: first that with `fraction` of the load (of the extent for equidistant cuts) below,
/// then steps to both sides. Step i is 0.6 i (1 + 0.15 i) crossing edges away. The surface and the options must outlive
/// the sequence.
class PlaneSequence {
 public:
    /// O(1); planes are made on demand.
    PlaneSequence(const Surface& surface, const MassProperties& mass, const Vec3& direction, std::int32_t axis,
                  double fraction, const CutOptions& options)
        : surface_(surface),
          options_(options),
          through_centroid_(mass.centroid, direction),
          axis_(axis),
          fraction_(fraction) {}

    /// Returns a plane that meets nothing, in the middle of a gap between bodies, whose load below is nearest to the
    /// fraction and within the load window. Returns nothing for equidistant cuts. Gaps shorter than a thousandth of the
    /// extent are not found. O(#V + #F).
    std::optional<PlaneCandidate> between_bodies() const;

    /// Returns the i-th plane, or null beyond the last. O(#V + #F) for the first plane and for the second, which makes
    /// all steps.
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
