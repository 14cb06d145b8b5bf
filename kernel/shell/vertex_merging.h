// Fewer points where cells are smaller than wanted.
#pragma once

#include <cstdint>

#include "delaunay/triangulation.h"
#include "size/size_field.h"

namespace kerf {

/// Merges vertices inside of a region with a neighbour if an edge of theirs is shorter than 0.7 times the wanted
/// length, and no cell gets too large (is_too_large()) or worse than the worst of those that it replaces, or than 12
/// degrees. Recovered faces and slender cells bring such vertices. They are left without cells. Deterministic.
void merge_close_vertices(Triangulation& triangulation, std::uint8_t region, const SizeField& size);

}  // namespace kerf
