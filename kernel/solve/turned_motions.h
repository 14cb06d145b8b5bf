// Rigid motions, as the multigrid wants them, along the nodes' own axes.
#pragma once

#include "solve/node_frames.h"

struct _p_MatNullSpace;

namespace kerf {

/// Replaces the motions, whose vectors have three numbers for each node of a rank, by those along the axes of `frames`.
/// They stay orthonormal. Collective; O(n). Returns PETSc's code.
int turn_into_frames(const NodeFrames& frames, _p_MatNullSpace** motions);

}  // namespace kerf
