// Triangles of a surface that a Delaunay triangulation does not have by itself.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"

namespace kerf {

/// The triangles as constrained faces, in the order of find_faces(): those that are there as they are; the others by
/// flips of the cells around the edges that are in their way, which leave the triangulation no longer Delaunay there.
/// Where flips alone do not help, new vertices are added beside the triangles, on either side of them.
struct RecoveredFaces {
    std::vector<CellFace> faces;  ///< of each triangle; Triangulation::none where nothing helped
    std::int64_t missing = 0;     ///< that were not there by themselves
    std::int64_t lost = 0;        ///< that are still not there
};

/// Two triangles must not meet but in common corners and edges. Deterministic. Linear, and some 50 us a missing one. It
/// is not complete: where long triangles lie close together, some may be lost.
RecoveredFaces recover_faces(Triangulation& triangulation, const std::vector<Triangle>& triangles);

}  // namespace kerf
