// Removal of points where cells are smaller than wanted.
#pragma once

#include <cstdint>

#include "fill/mesh/editable_tets.h"
#include "surface/size/size_field.h"

namespace kerf {

/// Merges vertices from number `first` on, none of which lies on the boundary, with a neighbour if an edge of theirs is
/// shorter than 0.7 times the wanted length, and no new cell is too large (is_too_large()), or is worse than both the
/// worst of those that are replaced and a cell of 12 degrees. Refinement of slender cells brings such vertices. Those
/// that are merged are left without cells. Deterministic.
void merge_close_vertices(EditableTets& tets, std::int32_t first, const SizeField& size);

}  // namespace kerf
