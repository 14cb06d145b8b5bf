// A mesh in memory as the parts of which it was joined.
#pragma once

#include <functional>

#include "files/part/part.h"
#include "kerf/kerf.h"

namespace kerf {

/// Calls take(part) for each part, ascending by number: its cells, its boundary with patches and neighbours, and global
/// numbers, which are those of the arrays; Part::facet are numbers of MeshArrays::triangles. Throws Error(usage) for
/// more vertices or tetrahedra than 32 bits number. Memory: neighbours of all tetrahedra, and one part.
void for_each_part_of(const MeshArrays& mesh, const std::function<void(const Part&)>& take);

}  // namespace kerf
