// Which axis and which share of the load a cut should take.
#pragma once

#include "cut/options.h"
#include "surface/mass_properties.h"

namespace kerf {

/// The place for a part that is to give `leaves` >= 2 leaves: across the first direction, floor(leaves/2)/leaves of the
/// load below, unless another direction or share has a clearly smaller section.
///
/// Only shares j/leaves within the load window are asked, which cost no balance; the gain must be 25 % at
/// least, and there must be eight leaves. Measured over the assets at 32 parts: up to 11 % less interface.
/// Only the inertia criterion leaves the choice. O(#F): sections are estimated from the centroids of the facets.
/// The options are those of this surface (CutOptions::of()).
CutPlace choose_place(const Surface& surface, const MassProperties& mass, std::int32_t leaves,
                      const CutOptions& options);

/// The place at which bisect() tries this plane first: across the direction that is nearest to its normal, with the
/// load that lies below it, at least a hundredth and at most all but that. Options as above. O(#V + #F).
CutPlace place_of(const Plane& plane, const Surface& surface, const MassProperties& mass, const CutOptions& options);

}  // namespace kerf
