// Features that are nearer to each other than the bound.
#pragma once

#include <functional>

#include "remesh/edited_surface.h"

namespace kerf {

/// Makes one feature of two that are nearer to each other than the tolerance, where the surface between them is of one
/// patch: a corner that is near another one, or near an edge of a feature beyond its facet, goes there. Between them
/// there would be needles, or facets as small as the way across. `poll` is called for every edge and facet that is
/// looked at. O(#F log #F).
void merge_features(EditedSurface& surface, const std::function<void()>& poll);

}  // namespace kerf
