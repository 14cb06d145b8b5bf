// Whether the shells of a body that is cut, those of voids above all, have come into the half in which they lie.
#pragma once

#include <cmath>

#include "cut/band.h"

namespace kerf {

/// Heights over a plane.
struct HeightSpan {
    double low = -INFINITY, high = INFINITY;
};

/// Where both halves of a cut have something, up to rounding: nothing of the half below lies higher, nothing of that
/// above lower. The span has the plane in it. O(band and interface).
HeightSpan shared_heights(const Band& band, const std::vector<Side>& side, const Interface& interface);

/// Whether a half may have a shell that lies within these heights, which must be the shared ones of the labels `side`.
/// Only such a shell can be misplaced. O(band); true without a search where they reach beyond the band.
bool may_misplace_shells(const Surface& surface, const Band& band, const std::vector<Side>& side,
                         const HeightSpan& shared);

/// Every shell of a half must enclose positive volume if it lies outside of all others, negative inside of the
/// material. Returns a vertex (of the half) of the first shell for which this fails, or -1. Only shells within the
/// heights are asked, of which there must be some for all others. O(#F) plus, for every box in another one, the facets
/// of that.
std::int32_t find_misplaced_shell(const Surface& half, const Plane& plane = {}, const HeightSpan& within = {});

}  // namespace kerf
