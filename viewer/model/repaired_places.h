// Where on a surface a place of a repair is.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/soup.h"

namespace kerf::view {

/// The facets of a soup that are cut from these faces of its file (RepairPlace::facets). Those that it does not have
/// are left out.
std::vector<std::int32_t> facets_of_file(const Soup& soup, const std::vector<std::int32_t>& faces);

/// How much around a place has to be seen to understand it: its facets, within bounds that follow from the diagonal of
/// the body.
double radius_around(const Soup& soup, const std::vector<std::int32_t>& facets, const Vec3& place, double diagonal);

}  // namespace kerf::view
