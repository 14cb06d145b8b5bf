// The stiffness of the elements and springs of a rank.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/elastic_problem.h"
#include "solve/symmetric_blocks.h"

namespace kerf {

/// What is summed over the elements.
struct StiffnessChoice {
    /// If given, the elements are straight ones of order 1 with the same corners, and their nodes have the numbers that
    /// are not negative here.
    std::vector<std::int32_t> corner_numbers = {};
    double mass_factor = 0;  ///< so many times the consistent mass is added
};

/// Rows and columns of x, y and z become those of the nodes' own axes. O(n).
void turn_into_frames(const NodeFrames& frames, SymmetricBlocks<3>& rows);

/// The stiffness of this rank's elements and springs over its local nodes, along their axes (ElasticProblem::frames),
/// before anything is held; what other ranks add at nodes that they have, too, is not there. O(n).
SymmetricBlocks<3> stiffness_of_rank(const ElasticProblem& problem, const StiffnessChoice& choice = {});

}  // namespace kerf
