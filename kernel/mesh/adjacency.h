// Which tetrahedra share a face.
#pragma once

#include "mesh/tet_mesh.h"

namespace kerf {

/// The neighbours as `tets` has them, whatever mesh.neighbours says. Of faces that more than two tetrahedra have, only
/// the first two are joined; verify_mesh() then finds the others. Requires vertex indices in range. O(#V + #T) for
/// bounded vertex degrees: about 250 ns a tetrahedron. Memory: 16 bytes a tetrahedron beside the result.
TetNeighbours find_neighbours(const TetMesh& mesh);

/// Keeps them in mesh.neighbours.
inline void connect_tets(TetMesh& mesh) { mesh.neighbours = find_neighbours(mesh); }

}  // namespace kerf
