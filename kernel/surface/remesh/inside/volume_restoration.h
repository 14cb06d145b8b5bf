// The restoration of the volumes that a remeshed surface has lost.
#pragma once

#include <vector>

#include "surface/remesh/inside/inspection.h"
#include "surface/soup/facet_sides.h"

namespace kerf {

/// Returns the largest difference of a region's volume from that in the input, as a share of the latter or, if that is
/// less, of `reference`; 0: of the latter. `sides` has the regions beside each patch; empty: one region behind all
/// facets.
double volume_difference(const SurfaceArrays& input, const SurfaceArrays& result, const std::vector<FacetSides>& sides,
                         double reference);

/// Moves the vertices of `result` off the input until each region has its volume again, by balance_volumes(): chords of
/// a curved surface leave out the space between them and it. Vertices between flat facets and curved ones move within
/// the flat ones. If the heights of the input over the facets do not suffice, all vertices that may move rise by the
/// same height, and flat facets that go on smoothly count as curved. `is_fixed` (#V): vertices that stay. Returns
/// false, and moves nothing, if that would take a rise of more than twice the `deviation`. The result may intersect
/// itself, and be further from the input than before. O(#F log #F), deterministic, on
/// threads.
bool restore_volumes(const InspectedInput& input, const std::vector<FacetSides>& sides, double deviation,
                     const std::vector<char>& is_fixed, ChangedSurface& result);

}  // namespace kerf
