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

/// How triangles are recovered that are not there.
struct RecoveryOptions {
    bool adds_vertices = true;  ///< flips may add vertices beside triangles before triangles are split
    double offset = 1e-2;       ///< see BoundarySplitting
};

/// Recovers the triangles of a closed surface, the body behind them: those that are there as they are; the others by
/// flips of the cells in their way, which leave the triangulation no longer Delaunay there; where flips do not help, by
/// vertices next to them, see BoundarySplitting.
///
/// Two triangles must not meet but in common corners and edges. It is not complete: where long triangles lie close
/// together, some may be lost, and others with other options. Exact, deterministic. Linear, and some 50 us a missing
/// one.
RecoveredFaces recover_faces(Triangulation& triangulation, const std::vector<Triangle>& triangles,
                             const RecoveryOptions& options = {});

}  // namespace kerf
