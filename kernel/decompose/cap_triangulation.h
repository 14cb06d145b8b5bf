// The interfaces of straight cuts, triangulated once no later cut can cross them any more.
#pragma once

#include "cut/options.h"
#include "decompose/face_complex.h"

namespace kerf {

/// Replaces the faces in the planes of straight cuts by well-shaped triangles; CutOptions::max_interface_edge() bounds
/// their edges.
///
/// A cap falls into one region for every pair of parts that it separates. Where caps cross each other the line is
/// divided anew, by sizes that grow from the surface; edges on the surface stay. Very short ones do not make the
/// triangles small. Where a region has no triangulation, which rounding of the contour could cause, all caps stay as
/// they are. O(n log n), n: faces.
void triangulate_caps(FaceComplex& complex, const CutOptions& options);

}  // namespace kerf
