// The vertices of a wrap, moved back onto the surface inside of it.
#pragma once

#include <functional>

#include "surface/soup/triangle_tree.h"
#include "surface/wrap/inside/alpha_wrap.h"

namespace kerf {

/// Moves the vertices of alpha_wrap() onto the input, each to its closest point. Edges that leave the input are divided
/// first, at the point where the planes of their ends meet if that is on the input, so that sharp edges and corners
/// return (Attene et al. 2003, attene2003). Where the wrap is thin, as around a sheet, vertices move less, so that
/// walls stay as thick as the offset. Vertices of facets that would turn over, fold or cross something are held back,
/// half of the way or all of it, until no facet does, by exact predicates: in the worst case the wrap comes back as it
/// is.
///
/// `wrap`, `offset`: of alpha_wrap(). `input`: the tree of its facets. The result is closed, manifold and without
/// intersections. Deterministic. O(#F log #F).
TriangleSet pulled_back(TriangleSet wrap, const TriangleTree& input, double offset,
                        const std::function<void()>& check_cancelled);

}  // namespace kerf
