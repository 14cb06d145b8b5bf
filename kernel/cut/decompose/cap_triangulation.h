// The triangulation of the interfaces of straight cuts, once no later cut can cross them any more.
#pragma once

#include <functional>

#include "cut/decompose/inside/face_complex.h"

namespace kerf {

/// The longest edge that the interface of a cut may have at a place, as CutOptions::max_interface_edge() computes it;
/// infinity: any.
using CapEdgeLength = std::function<double(NodeId cut, const Vec3& place)>;

/// Replaces the faces in the planes of straight cuts by well-shaped triangles, whose edges `longest_edge` bounds.
///
/// A cap falls into one region for every pair of parts that it separates. Where caps cross each other, the line is
/// divided anew, by sizes that grow from the surface; edges on the surface stay, and very short ones do not make the
/// triangles small. If a region has no triangulation, which rounding of the contour could cause, all caps stay as they
/// are. O(n log n) for n faces.
void triangulate_caps(FaceComplex& complex, const CapEdgeLength& longest_edge);

}  // namespace kerf
