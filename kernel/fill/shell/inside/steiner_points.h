// Removal of vertices that recovery has added, or moves to better places.
#pragma once

#include <cstdint>

#include "fill/mesh/editable_tets.h"

namespace kerf {

/// Merges each vertex from number `first` on with a neighbour where that leaves positive cells that are better than the
/// worst at it, and otherwise moves it to where the worst of its cells is best. None of them may lie on the boundary.
/// Returns how many are left. Deterministic. Linear.
std::int64_t settle_steiner_points(EditableTets& tets, std::int32_t first);

}  // namespace kerf
