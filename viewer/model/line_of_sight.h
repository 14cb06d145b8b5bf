// Directions from which a place of a surface can be seen.
#pragma once

#include <optional>
#include <vector>

#include "base/core/types.h"

namespace kerf::view {

/// Returns the mean of the normals of these facets, weighted by area, of length 1; zero if they cancel out or the
/// facets have no area.
Vec3 mean_normal(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                 const std::vector<std::int32_t>& chosen);

/// Returns a direction from a place to the eye in which no facet lies before the place: `present` if that does not look
/// along the surface, else the first free one of those around `outward`, which may point inwards by mistake; none if
/// all are blocked. Directions have length 1, but `outward` may be zero. Facets nearer to the place than `near` belong
/// to it. O(#F) for each direction that is tried, of which there are at most 27.
std::optional<Vec3> direction_to_eye(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                     const Vec3& place, double near, const Vec3& outward, const Vec3& present);

}  // namespace kerf::view
