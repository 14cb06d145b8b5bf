// The division of a surface into blocks, which are changed on threads.
#pragma once

#include <functional>
#include <vector>

#include "surface/remesh/inside/bounded_surface.h"

namespace kerf {

/// Calls work(near) with the facets that may change and some rings of kept ones around them, or if most may change,
/// with all; and puts what has become of them into the state. Facets and vertices are numbered anew. O(#F), and what
/// the work costs.
void change_apart_from_kept(SheetState& state, const std::function<void(SheetState& near)>& work);

/// Calls work(surface) for all facets at once, and puts what has become of them into the state. O(#F), and what the
/// work costs.
void change_at_once(const InputShape& input, SheetState& state, const std::function<void(BoundedSurface&)>& work);

/// Numbers the blocks (SheetFacet::block) into which the chosen facets (#F) are divided along Morton's curve, of about
/// the same sum of `weights` (#F) and of at least `least`; others belong to none. `is_turned`: the curve runs along
/// other axes, so that borders cross those of blocks along the usual ones. The number of blocks, which is returned,
/// follows from the weights alone. O(#F).
std::int32_t divide_along_curve(SheetState& state, const std::vector<char>& chosen, const std::vector<float>& weights,
                                double least, bool is_turned);

/// Numbers blocks of chosen facets (#F) that have no vertex in common, each of at least one connected component and of
/// about as many facets as `wanted`. Returns their number. O(#F).
std::int32_t divide_by_components(SheetState& state, const std::vector<char>& chosen, std::int32_t wanted);

/// Calls work(surface) for every block, on threads, and puts what has become of it into the state. Facets and vertices
/// are numbered anew. O(#F), and what the work costs.
void change_blocks(const InputShape& input, SheetState& state, const std::function<void(BoundedSurface&)>& work);

/// Returns the facets (#F) that may change within some rings of facets around the vertices that blocks have in common,
/// 0 if there are none. O(#F).
std::vector<char> facets_beside_borders(const SheetState& state);

}  // namespace kerf
