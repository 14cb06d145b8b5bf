// Points added where cells are too large or too slender.
#pragma once

#include <cstdint>

#include "fill/delaunay/spatial_triangulation.h"
#include "surface/size/size_field.h"

namespace kerf {

struct RefinementBounds {
    SizeField size = {};     ///< bound of sizes, see is_too_large()
    double radius_edge = 0;  ///< bound of circumradius over shortest edge; 0: none
};

/// Inserts points into cells that exceed a bound, next to their circumcentres (Ruppert 1995, ruppert1995; Shewchuk
/// 1998, shewchuk1998), as long as no cell is made that is much worse, but for cells that will be divided next: a few
/// stay as they are, next to constrained faces above all. For shapes, and for sizes that differ, no point comes into
/// the smallest sphere around a constrained face, as in TetGen; a constant size is a bound, and is kept there, too.
/// There must be no ghosts (EditableTets::keep_cells()). Returns the number of points. Deterministic. Some 10 us a
/// point.
std::int64_t refine(SpatialTriangulation& triangulation, const RefinementBounds& bounds);

}  // namespace kerf
