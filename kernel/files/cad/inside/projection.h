// Puts points on the faces and curves of a model.
#pragma once

#include <vector>

#include "files/cad/inside/model.h"
#include "files/io/cad_points.h"

namespace kerf::cad {

/// Puts points on shapes that have been tessellated: on the nearest of the faces of their patches, or of the curves
/// that faces of all of their patches share; on the nearest face of theirs if there is no such curve. The facets of a
/// face, and straight pieces of a curve, tell where to start on it. `patches`: the patches of `shapes`; `millimetres`:
/// length of the unit of the points. Deterministic. O(log #F) a point: about a microsecond on analytic faces, 10 on
/// free-form ones.
ProjectedPoints project_points(const std::vector<Body>& shapes, const std::vector<Patch>& patches,
                               const CadPoints& points, double millimetres);

}  // namespace kerf::cad
