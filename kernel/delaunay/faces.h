// From the triangles of a surface to faces of cells, and to the cells that they enclose.
#pragma once

#include <optional>
#include <vector>

#include "delaunay/triangulation.h"

namespace kerf {

/// For each triangle: the face with these vertices, seen from the cell behind it, which is on the side from which the
/// triangle turns clockwise: mirror() of it belongs to the cell in front. Triangulation::none if there is no such face.
/// Time is linear in cells and triangles where no vertex is the smallest one of very many triangles.
std::vector<CellFace> find_faces(const Triangulation& triangulation, const std::vector<Triangle>& triangles);

/// Whether each cell can be reached from the cells behind these faces, which must be constrained, without crossing a
/// constrained face. No result if a ghost or a cell in front of one of the faces can be: then they do not enclose
/// anything. Linear.
std::optional<std::vector<bool>> cells_behind(const Triangulation& triangulation, const std::vector<CellFace>& faces);

}  // namespace kerf
