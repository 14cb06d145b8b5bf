// The tree of cuts, each made on one rank.
#pragma once

#include "base/parallel/communicator.h"
#include "cut/decompose/decomposition.h"

namespace kerf {

/// Does the work of decompose() on all ranks: each returns the leaves of its range (range_of_rank()) and the nodes that
/// belong to it, in the order of the tree. A node belongs to the rank that has its first leaf. That rank alone cuts it,
/// and sends a half that belongs to another rank there as soon as it is made: surfaces travel from lower to higher
/// ranks, of one region from the first rank, each facet once for each rank that has it on its way. Waiting ranks sleep.
///
/// `complex`: on all ranks if it has several regions, of which each rank takes its own; else on the first rank, where
/// it is empty afterwards, and empty on the others. Collective; not for one rank alone. An error on some rank, or a
/// listener there that wants the end, ends the cuts of all ranks, and is thrown on all of them alike. The result
/// depends on complex and options alone, but for the seconds, which are those of the rank that made the cut.
Decomposition decompose_on_ranks(Communicator& ranks, Complex& complex, const DecomposeOptions& options,
                                 CutListener* listener);

}  // namespace kerf
