// Recovery of surface triangles that are no faces of a Delaunay triangulation.
#pragma once

#include <vector>

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf {

/// A closed surface in a triangulation.
struct RecoveredFaces {
    std::vector<CellFace> faces;     ///< constrained faces, seen from the body: they enclose it, but for the caps
    std::vector<Tetrahedron> caps;   ///< cells of the body between the faces and triangles that were split
    std::int64_t missing = 0;        ///< number of triangles that were not faces by themselves
    std::int64_t split = 0;          ///< number of these that flips could not make
    std::vector<std::int32_t> lost;  ///< numbers of triangles that are still no faces, or a part of which is none
};

/// Recovers the triangles of a closed surface, the body behind them.
///
/// First the edges are recovered, while faces may come and go; then the triangles themselves, by flips of cells in
/// their way (see FlipRecovery); then vertices are added behind those that are still missing; in the end these are
/// split at such vertices (see BoundarySplitting). Afterwards the triangulation is no longer Delaunay there.
///
/// Two triangles must not meet but in common corners and edges. The method is not complete: where parts of the surface
/// are so close together that hardly a double lies between, some may be lost. Exact, deterministic. Linear where
/// nothing is missing; some 0.1 to 10 ms a missing triangle.
RecoveredFaces recover_faces(SpatialTriangulation& triangulation, const std::vector<Triangle>& triangles);

}  // namespace kerf
