// Flips that make cells Delaunay.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "fill/mesh/editable_tets.h"

namespace kerf {

/// Flips faces for as long as the sphere around one of a face's two cells contains the other one's vertex, and the two,
/// or three around an edge, can be replaced (Lawson 1977, lawson1977; Joe 1991, joe1991). Constrained faces stay. Each
/// flip brings the cells nearer to the constrained Delaunay triangulation, but not always all the way: where no flip is
/// possible, they stay as they are. There must be no ghosts. Returns the number of flips. Deterministic. Linear in
/// cells and flips.
std::int64_t flip_to_delaunay(EditableTets& tets);
/// Flips only from the faces of the given cells and of those that flips make; cells that are not Delaunay elsewhere
/// stay so. `on_made` is told of each new cell, which a later flip may replace.
std::int64_t flip_to_delaunay(EditableTets& tets, std::span<const CellId> cells,
                              const std::function<void(CellId cell)>& on_made);

}  // namespace kerf
