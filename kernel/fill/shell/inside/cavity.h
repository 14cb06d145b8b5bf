// Cells that are to be removed together.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf {

/// A function that tells whether an edge must stay.
using IsKept = std::function<bool(std::int32_t, std::int32_t)>;

/// Returns the faces around cells, seen from inside. Quadratic in the number of cells.
std::vector<CellFace> sides_of(const EditableTets& tets, std::span<const CellId> cavity);

/// Returns whether cells may be removed: no vertex, no constrained face, and no edge that is kept is inside of them.
/// Quadratic in their number.
bool may_be_removed(const EditableTets& tets, std::span<const CellId> cavity, const IsKept& is_kept);

}  // namespace kerf
