// Patches of a surface between its sharp edges, and its largest connected component.
#pragma once

#include "surface/soup/soup.h"

namespace kerf {

/// Divides a soup into patches at the edges with more than `angle_deg` between the normals of their facets. The patches
/// are named "face_1", "face_2", ... in the order of their first facets. Requires consistently oriented facets. O(#F
/// log #F), deterministic. Returns the number of patches.
std::int32_t make_feature_patches(Soup& soup, double angle_deg);

/// Keeps only the component of the largest area, where facets with a common vertex belong to one component. All else
/// goes, including voids. Returns the number of facets removed. O(#V + #F).
std::int64_t keep_largest_component(Soup& soup);

}  // namespace kerf
