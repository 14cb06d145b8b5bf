// A remeshed surface holds what the input holds.
#pragma once

#include <vector>

#include "remesh/remesh.h"
#include "surface/triangle_tree.h"

namespace kerf {

/// The largest difference of the volume of a region to that in the input, as a share of that. `sides`: of the patches;
/// empty: one region behind all facets.
double volume_difference(const SurfaceArrays& input, const SurfaceArrays& result, const std::vector<FacetSides>& sides);

/// Chords of a curved surface leave out what is between them and it. Moves the vertices of `result` off the input until
/// each region has its volume again, as balance_volumes() does; edges between flat facets and curved ones move within
/// the flat ones. Where what chords leave out is not enough, all that may move rises by the same, and flat facets that
/// go on smoothly are curved ones. `is_fixed` (#V): vertices that stay. False, and nothing is moved, where that would
/// take a rise of more than twice the `deviation`. The result may intersect itself, and be further from the input than
/// it was. O(#F log #F), deterministic.
bool restore_volumes(const SurfaceArrays& input, const TriangleTree& tree, const std::vector<FacetSides>& sides,
                     double deviation, const std::vector<char>& is_fixed, SurfaceArrays& result);

}  // namespace kerf
