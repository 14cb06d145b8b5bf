// The joining of features that are nearer to each other than the bound.
#pragma once

#include <functional>

#include "surface/remesh/inside/edited_surface.h"

namespace kerf {

/// Makes one feature of two that are nearer to each other than the tolerance, where the surface between them belongs to
/// one patch: a corner that is near another corner, or near a feature edge on the other side of its facet, is moved
/// there. Between such features there would only be needles, or facets as small as their distance. `poll` is called for
/// every edge and facet. O(#F log #F).
void merge_features(EditedSurface& surface, const std::function<void()>& poll);

}  // namespace kerf
