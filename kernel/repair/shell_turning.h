// Facets that are turned the wrong way round, where facets may cross.
#pragma once

#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Facets to be turned so that shells agree in themselves and have what they enclose behind them (#F; 1: turn).
///
/// Facets that edges of two facets connect are a shell; most of its facets stay as they are. A closed one is turned
/// outwards where the others do not wind around it; where they do, once or more, it stays: one that points inwards is a
/// void, one that points outwards a body in a body. What lies in a shell that is inside out is turned with it. Open
/// shells agree in themselves and stay; so do one-sided ones, of which no choice is right.
///
/// `facets`: in range; those with a repeated vertex stay. They may cross: then the larger part of a shell decides. O(#F
/// log #F), deterministic. `poll` may throw.
std::vector<char> find_turned_facets(
    const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const std::function<void()>& poll = [] {});

}  // namespace kerf
