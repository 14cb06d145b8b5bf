// The order in which points are inserted: each is found near the one before.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Returns the place of a cell of the grid 2^bits x 2^bits x 2^bits on Hilbert's curve: from 0 to 8^bits - 1,
/// neighbours on the curve are neighbours in the grid. 0 < bits <= 20, coordinates below 2^bits.
std::uint64_t hilbert_code(std::array<std::uint32_t, 3> cell, int bits);

/// Returns the numbers of all points in a biased randomised insertion order (Amenta, Choi and Rote 2003, amenta2003):
/// in rounds, each some times as large as the one before, whose points a hash of their number draws, and along
/// Hilbert's curve within a round. O(n log n) time, 16 bytes a point. Depends on the points and their numbers alone.
std::vector<std::int32_t> insertion_order(const std::vector<Vec3>& points);

}  // namespace kerf
