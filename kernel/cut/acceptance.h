// The proof that an interface is valid, and the measures that make it a good one.
#pragma once

#include <vector>

#include "cut/interface.h"
#include "cut/options.h"

namespace kerf {

/// What was found about an interface.
struct Verdict {
    Refusal refusal = Refusal::none;
    std::vector<std::int32_t> failed;        ///< vertices of the surface at the failure
    InterfaceQuality quality;                ///< set if the refusal is none or soft
    std::vector<Collision> collisions = {};  ///< of an intersection, at most max_collisions
};

/// Checks an interface, which must have triangles, against the surface that it cuts: no edge off the contour in common,
/// no intersection of any interface triangle with the surface or another interface triangle (exact), then the smallest
/// dihedral angle at the contour, interface angle and gap against the thresholds of `options` (else the refusal is
/// soft). Cost follows the number of triangles near the interface.
Verdict judge_interface(const Surface& surface, const Band& band, const Interface& interface,
                        const CutOptions& options);

}  // namespace kerf
