// The stiffness of the elements and springs of a rank.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/equations/elastic_problem.h"
#include "solve/multigrid/symmetric_blocks.h"

namespace kerf {

/// The terms that are summed over the elements.
struct StiffnessChoice {
    /// If given, straight elements of order 1 with the same corners are summed, and these are the numbers of the local
    /// nodes in the matrix; negative: not in it.
    std::vector<std::int32_t> corner_numbers = {};
    double mass_factor = 0;  ///< multiple of the consistent mass that is added
};

/// Turns rows and columns along x, y and z into those along the nodes' own axes. O(n).
void turn_into_frames(const NodeFrames& frames, SymmetricBlocks<3>& rows);

/// Returns the stiffness of this rank's elements and springs over its local nodes, along their axes
/// (ElasticProblem::frames), before anything is held and without the shares of other ranks at nodes that they have,
/// too. O(n).
SymmetricBlocks<3> stiffness_of_rank(const ElasticProblem& problem, const StiffnessChoice& choice = {});

}  // namespace kerf
