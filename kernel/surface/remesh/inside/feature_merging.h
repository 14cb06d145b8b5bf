// The merging of features that are nearer to each other than the bound.
#pragma once

#include <functional>

#include "surface/remesh/inside/bounded_surface.h"

namespace kerf {

/// Makes one feature of two that are nearer to each other than the tolerance, where the surface between them belongs to
/// one patch: a corner that is near another corner, or near a feature edge on the other side of its facet, is moved
/// there. Between such features there would only be needles, or facets as small as their distance. `check_cancelled` is
/// called for every edge and facet. O(#F log #F).
void merge_features(BoundedSurface& surface, const std::function<void()>& check_cancelled);

/// Whether the corner of some facet is on a feature and nearer than the tolerance to another one at the side opposite:
/// strips that merge_features() closes. O(#F).
bool has_narrow_strips(const SheetArrays& sheets);

}  // namespace kerf
