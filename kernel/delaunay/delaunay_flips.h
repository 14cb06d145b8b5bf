// Cells that are not Delaunay, made so by flips.
#pragma once

#include <cstdint>

#include "mesh/editable_tets.h"

namespace kerf {

/// Flips faces for as long as the sphere around one of a face's two cells contains the other one's vertex, and the two,
/// or three around an edge, can be replaced (lawson1977, joe1991). Constrained faces stay. Each flip brings the cells
/// nearer to the constrained Delaunay triangulation, but not all there: where no flip is possible, they stay as they
/// are. There must be no ghosts. Returns the number of flips. Deterministic. Linear in cells and flips.
std::int64_t flip_to_delaunay(EditableTets& tets);

}  // namespace kerf
