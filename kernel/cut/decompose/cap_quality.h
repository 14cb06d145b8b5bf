// The quality of the finished interfaces of straight cuts.
#pragma once

#include <map>

#include "cut/decompose/inside/face_complex.h"

namespace kerf {

/// The finished interface of a straight cut. Its gap to the surface is not measured: gap_rel is NaN.
struct CapMeasures {
    std::int32_t faces = 0;
    InterfaceQuality quality;
};

/// Measures the cap of every straight cut: the angles of its triangles, and the dihedral angles along its border with
/// the other faces of both parts. O(n log n) for n faces in caps and beside them.
std::map<NodeId, CapMeasures> measure_caps(const FaceComplex& complex);

}  // namespace kerf
