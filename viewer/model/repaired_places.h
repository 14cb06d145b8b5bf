// The facets and the surroundings of a place of a repair on a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf::view {

/// Returns the facets of a soup that are cut from these faces of its file (RepairPlace::facets). Faces that the soup
/// does not have are left out.
std::vector<std::int32_t> facets_of_file(const Soup& soup, const std::vector<std::int32_t>& faces);

/// Returns the radius around a place that has to be seen to understand it: that of its facets with some more, within
/// bounds that follow from the diagonal of the body.
double radius_around(const Soup& soup, const std::vector<std::int32_t>& facets, const Vec3& place, double diagonal);

}  // namespace kerf::view
