// The proof that an interface is valid, and the measures that make it a good one.
#pragma once

#include <vector>

#include "cut/cut/inside/interface.h"
#include "cut/cut/inside/options.h"

namespace kerf {

/// The verdict on an interface.
struct Verdict {
    Refusal refusal = Refusal::none;
    std::vector<Vertex> failed;              ///< vertices of the surface at which the interface fails
    InterfaceQuality quality;                ///< set if the refusal is none or soft
    std::vector<Collision> collisions = {};  ///< if the refusal is intersection; at most max_collisions
};

/// Judges an interface, which must have triangles, against the surface that it cuts. It must have no edge in common
/// with the surface off the contour, and none of its triangles may intersect the surface or another one of them
/// (exact). Then its smallest dihedral angle at the contour, triangle angle and gap must reach the thresholds of
/// `options`, else the refusal is soft. Cost follows the number of triangles near the interface.
Verdict judge_interface(const Surface& surface, const Band& band, const Interface& interface,
                        const CutOptions& options);

}  // namespace kerf
