// Parts as the arrays of one mesh.
#pragma once

#include "kerf/kerf.h"
#include "part/part_store.h"

namespace kerf {

/// The mesh of all parts, by so many threads. Memory beside the result: for each thread a few megabytes and what grows
/// with the boundary of its part, 8 bytes for each vertex of it. Throws Error(io).
MeshArrays arrays_of_parts(const StoredParts& parts, int threads);

/// The same of any parts, one at a time: first the points of all, then the cells; of order 2 together.
MeshArrays arrays_of_parts(const PartSource& parts);

}  // namespace kerf
