// The faces of cells that are triangles of a surface, and the cells that these enclose.
#pragma once

#include <optional>
#include <vector>

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf {

/// Returns for each triangle the face with its vertices, seen from the cell behind it: that is on the side from which
/// the triangle turns clockwise, and mirror() of the face belongs to the cell in front. SpatialTriangulation::none if
/// there is no such face. Time is linear in cells and triangles where no vertex is the smallest one of very many
/// triangles.
std::vector<CellFace> find_faces(const SpatialTriangulation& triangulation, const std::vector<Triangle>& triangles);

/// Returns for each cell whether it can be reached from the cells behind these faces, which must be constrained,
/// without crossing a constrained face. No result if a ghost, or a cell in front of one of the faces, can be reached:
/// then they do not enclose anything. Linear.
std::optional<std::vector<bool>> cells_behind(const SpatialTriangulation& triangulation,
                                              const std::vector<CellFace>& faces);

}  // namespace kerf
