// The choice of the axis and the share of the load for a cut.
#pragma once

#include "cut/cut/inside/options.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

/// Returns the place for cutting a part that is to give `leaves` >= 2 leaves: across the first direction with
/// floor(leaves/2)/leaves of the load below, unless another direction or share has a clearly smaller section.
///
/// Only shares j/leaves within the load window are considered, which cost no balance; the gain must be 25 % at least,
/// and there must be eight leaves. Measured over the assets at 32 parts: up to 11 % less interface. Only the inertia
/// criterion leaves a choice. O(#F): sections are estimated from the centroids of the facets. The options must be those
/// of this surface (CutOptions::of()).
CutPlace choose_place(const Surface& surface, const MassProperties& mass, std::int32_t leaves,
                      const CutOptions& options);

/// Returns the place at which bisect() tries this plane first: across the direction nearest to its normal, with the
/// load that lies below it, but at least a hundredth and at most 99 hundredths of it. Options as above. O(#V + #F).
CutPlace place_of(const Plane& plane, const Surface& surface, const MassProperties& mass, const CutOptions& options);

}  // namespace kerf
