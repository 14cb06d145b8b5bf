// From where a place of a surface can be seen.
#pragma once

#include <optional>
#include <vector>

#include "core/types.h"

namespace kerf::view {

/// The mean of the normals of these facets, by area, of length 1; zero if they cancel out or are flat.
Vec3 mean_normal(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                 const std::vector<std::int32_t>& chosen);

/// A direction from a place to the eye in which no facet lies before it: `present` if it does not look along the
/// surface, else the first of those around `outward`, which may point inwards by mistake, that will do; none if none
/// does. Of length 1, as the directions given are; `outward` may be zero. What is nearer to the place than `near`
/// belongs to it. O(#F) for each direction that is tried, of which there are at most 27.
std::optional<Vec3> direction_to_eye(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                     const Vec3& place, double near, const Vec3& outward, const Vec3& present);

}  // namespace kerf::view
