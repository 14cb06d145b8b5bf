// Which tetrahedra share a face.
#pragma once

#include "mesh/tet_mesh.h"

namespace kerf {

/// Fills mesh.neighbours from mesh.tets. Of faces that more than two tetrahedra have, only the first two are joined;
/// verify_mesh() then finds the others. Requires vertex indices in range. O(#V + #T) for bounded vertex degrees.
void connect_tets(TetMesh& mesh);

}  // namespace kerf
