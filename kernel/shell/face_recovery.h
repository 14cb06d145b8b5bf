// Triangles of a surface that a Delaunay triangulation does not have by itself.
#pragma once

#include <vector>

#include "delaunay/triangulation.h"

namespace kerf {

/// A closed surface in a triangulation.
struct RecoveredFaces {
    std::vector<CellFace> faces;     ///< constrained, seen from the body: they enclose it, but for the caps
    std::vector<Tetrahedron> caps;   ///< cells of the body between the faces and triangles that were split
    std::int64_t missing = 0;        ///< triangles that were not there by themselves
    std::int64_t split = 0;          ///< of them, those that flips could not make
    std::vector<std::int32_t> lost;  ///< numbers of triangles that are still not there, or a part of which is not
};

/// Recovers the triangles of a closed surface, the body behind them.
///
/// First their edges, while faces may come and go, then the triangles themselves, by flips of what is in their way (see
/// FlipRecovery), then with vertices behind those that are still missing; in the end these are split at such vertices
/// (see BoundarySplitting). Afterwards the triangulation is no longer Delaunay there.
///
/// Two triangles must not meet but in common corners and edges. It is not complete: where parts of the surface are so
/// close together that hardly a double lies between, some may be lost. Exact, deterministic. Linear where nothing is
/// missing; some 0.1 to 10 ms a missing one.
RecoveredFaces recover_faces(Triangulation& triangulation, const std::vector<Triangle>& triangles);

}  // namespace kerf
