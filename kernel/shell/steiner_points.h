// Vertices that recovery has added, taken away again or moved to better places.
#pragma once

#include <cstdint>

#include "mesh/editable_tets.h"

namespace kerf {

/// Merges each vertex from number `first` on with a neighbour where that leaves positive cells that are better than the
/// worst at it, and moves it to where the worst of its cells is best otherwise. None of them may lie on the boundary.
/// Returns how many are left. Deterministic. Linear.
std::int64_t settle_steiner_points(EditableTets& tets, std::int32_t first);

}  // namespace kerf
