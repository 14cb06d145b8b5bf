// Facets that have to be turned over, where facets may cross.
#pragma once

#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Returns which facets are to be turned so that shells agree in themselves and have the space that they enclose behind
/// them (#F; 1: turn).
///
/// Facets that edges of two facets connect are a shell; most of its facets stay as they are. A closed shell is turned
/// outwards where the others do not wind around it; where they do, once or more, it stays: one that points inwards is a
/// void, one that points outwards a body in a body. Shells within one that is inside out are turned with it. Open
/// shells are made to agree in themselves and stay otherwise; so do one-sided ones, of which no choice is right.
///
/// `facets`: in range; those with a repeated vertex stay. They may cross: then the larger part of a shell decides. O(#F
/// log #F), deterministic. `check_cancelled` may throw.
std::vector<char> find_turned_facets(
    const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
    const std::function<void()>& check_cancelled = [] {});

}  // namespace kerf
