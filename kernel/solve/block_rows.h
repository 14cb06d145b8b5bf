// A sparse matrix of 3 x 3 blocks over the local nodes of a rank.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/elastic_problem.h"

namespace kerf {

/// Row n has the blocks of columns[first[n]] to columns[first[n + 1] - 1], ascending, blocks row by row.
struct BlockRows {
    std::vector<std::int64_t> first;
    std::vector<std::int32_t> columns;
    std::vector<double> values;

    std::int32_t row_count() const { return std::ssize(first) - 1; }
};

/// Rows and columns of x, y and z become those of the nodes' own axes. O(n).
void turn_into_frames(const NodeFrames& frames, BlockRows& rows);

/// The stiffness of this rank's elements and springs, along the nodes' axes (ElasticProblem::frames), before anything
/// is held; ghosts have rows as well. O(n).
BlockRows stiffness_of_rank(const ElasticProblem& problem);

}  // namespace kerf
