// How good the interfaces of straight cuts have become.
#pragma once

#include <map>

#include "decompose/face_complex.h"

namespace kerf {

/// The finished interface of a straight cut. Its gap to the surface is not measured: gap_rel is NaN.
struct CapMeasures {
    std::int32_t faces = 0;
    InterfaceQuality quality;
};

/// Measures of every straight cut: angles of its triangles, dihedral angles with the other faces of both parts along
/// their border. O(n log n), n: faces of caps and beside them.
std::map<NodeId, CapMeasures> measure_caps(const FaceComplex& complex);

}  // namespace kerf
