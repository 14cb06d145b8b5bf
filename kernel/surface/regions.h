// Regions of a surface: patches between sharp edges, and what hangs together.
#pragma once

#include "surface/soup.h"

namespace kerf {

/// Gives every region of facets that is bounded by edges with more than `angle_deg` between the normals of their facets
/// a patch of its own, named "face_1", "face_2", ... in the order of their first facets. Requires consistently oriented
/// facets. O(#F log #F), deterministic. Returns the number of patches.
std::int32_t make_feature_patches(Soup& soup, double angle_deg);

/// Keeps only the facets that hang together over vertices with those of the largest sum of areas; everything else goes,
/// voids, too. Returns the number of facets removed. O(#V + #F).
std::int64_t keep_largest_component(Soup& soup);

}  // namespace kerf
