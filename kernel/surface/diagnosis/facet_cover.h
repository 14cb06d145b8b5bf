// The test whether pieces of a facet cover it.
#pragma once

#include <array>
#include <span>

#include "base/core/types.h"

namespace kerf {

/// True if the pieces cover the facet exactly once with its orientation, up to the rounding of the coordinates: every
/// piece lies in the facet, none is turned over, and the areas add up.
bool covers(const std::array<Vec3, 3>& facet, std::span<const std::array<Vec3, 3>> pieces);

}  // namespace kerf
