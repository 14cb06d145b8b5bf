// Parts as the arrays of one mesh.
#pragma once

#include "files/part/part_store.h"
#include "kerf/kerf.h"

namespace kerf {

/// Returns the mesh of all parts, made by `threads` threads. Memory beside the result: for each thread a few megabytes
/// and arrays that grow with the boundary of its part, 8 bytes for each vertex of it. Throws Error(io).
MeshArrays arrays_from_parts(const StoredParts& parts, int threads);

/// Returns the mesh of all parts of any source, loaded one at a time: first the points of all, then the cells; for
/// order 2 both together.
MeshArrays arrays_from_parts(const PartSource& parts);

}  // namespace kerf
