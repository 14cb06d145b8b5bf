// The check that the shells of a body that is cut, above all those of voids, have come into the half in which they lie.
#pragma once

#include <cmath>

#include "cut/cut/inside/band.h"

namespace kerf {

/// A range of heights over a plane.
struct HeightSpan {
    double low = -INFINITY, high = INFINITY;
};

/// Returns the heights that both halves of a cut reach, up to rounding: the half below ends where the span does, the
/// half above begins where it begins. The span contains the plane. O(band and interface).
HeightSpan shared_heights(const Band& band, const Array<Facet, Side>& side, const Interface& interface);

/// Whether a half may have a shell that lies within these heights, which must be the shared_heights() of the labels
/// `side`. Only such a shell can be misplaced. O(band); true without a search if the heights reach beyond the band.
bool may_misplace_shells(const Surface& surface, const Band& band, const Array<Facet, Side>& side,
                         const HeightSpan& shared);

/// Returns a vertex (of the half) of the first misplaced shell, or none: every shell must enclose positive volume if it
/// lies outside of all others, and negative volume inside of the material. Only shells within the heights are looked
/// at; the caller must know that all others are right. O(#F) plus, for every box in another one, the facets of the
/// latter.
Vertex find_misplaced_shell(const Surface& half, const Plane& plane = {}, const HeightSpan& within = {});

}  // namespace kerf
