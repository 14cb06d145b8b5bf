// Rigid motions, as the multigrid wants them, along the nodes' own axes.
#pragma once

#include <petscmat.h>

#include "solve/node_frames.h"

namespace kerf {

/// Replaces the motions, whose vectors have three numbers for each node of a rank, by those along the axes of `frames`.
/// They stay orthonormal. Collective; O(n). Returns PETSc's code.
PetscErrorCode turn_into_frames(const NodeFrames& frames, MatNullSpace* motions);

}  // namespace kerf
