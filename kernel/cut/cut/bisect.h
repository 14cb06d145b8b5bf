// The bisection of a closed surface, by a ladder of strategies.
#pragma once

#include <array>

#include "cut/cut/place.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

/// The record of a bisection, and the halves if a cut was made.
struct Bisection {
    Cut cut;
    std::array<Surface, 2> halves;  ///< below, above; empty if !cut.made()
};

/// Cuts a surface, which must not be empty, at `place`: the fraction in (0, 1) of the load below the first plane, and
/// the number of the direction (cut_directions()) that is tried first. `mass` are the properties of the surface.
///
/// The ladder is: a plane between bodies that lie apart, which cuts none; the minimum cut; local repair (the weights at
/// the failed places are raised and the same plane is solved again); steps of the plane within the load window; the
/// other axes; the best soft cut; no cut. Every accepted cut is proven: it has no intersection, both halves are closed
/// 2-manifolds, and every shell is in its half. The result depends on the surface, node, place and options alone.
/// `record` makes it fill Cut::side, Cut::stages, CutTry::contour and CutTry::collisions, and changes nothing else.
Bisection bisect(const Surface& surface, const MassProperties& mass, NodeId node, const CutPlace& place,
                 const CutOptions& options, bool record);

}  // namespace kerf
