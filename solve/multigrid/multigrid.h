// A preconditioner for the equations of elasticity.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "solve/multigrid/inside/smoothed_aggregation.h"
#include "solve/multigrid/level_matrix.h"
#include "solve/multigrid/node_frames.h"

namespace kerf {

/// A level of a multigrid and all coarser ones: a fixed symmetric approximation of the inverse of its matrix.
class MultigridLevel {
 public:
    virtual ~MultigridLevel() = default;
    /// Sets x, for the owned nodes, to the result of one V-cycle from zero. Vectors have room for all local nodes.
    /// Collective.
    virtual void cycle(const std::vector<double>& right, std::vector<double>& x) = 0;
};

/// The nodes of order 1 of which a node of order 2 is the mean: one for a corner, two for the middle of an edge.
struct MiddleOf {
    std::array<std::int32_t, 2> ends{-1, -1};  ///< the second is negative for a corner
};

/// Returns a multigrid by smoothed aggregation (Vanek, Mandel and Brezina 1996, vanek1996) with Chebyshev smoothing
/// before and after. Its first matrix is `matrix`, which has to outlive it; the last one, of few nodes or of a slender
/// body, is factorised on every rank. `is_held`: of each local degree of freedom, whether it stays zero. Collective.
/// O(n); about half of the memory of the matrix for order 1. Bytes are the same for the same number of ranks.
std::unique_ptr<MultigridLevel> make_multigrid(MpiRanks& ranks, const LevelMatrix<3>& matrix, NearNullSpace motions,
                                               const std::vector<std::uint8_t>& is_held);

/// The level of the elements of order 1 with the same corners as those of order 2.
struct CornerLevel {
    LevelMatrix<3> matrix;
    NearNullSpace motions;
    std::vector<std::uint8_t> is_held;  ///< of each local degree of freedom of `matrix`
    NodeFrames frames;                  ///< of its local nodes
    std::vector<MiddleOf> middles;      ///< of each owned node of order 2: the local nodes of which it is the mean
};

/// Returns a multigrid for elements of order 2, which smooths there and corrects by `corners` (p-multigrid; Ronquist
/// and Patera 1987, ronquist1987). `matrix` and `frames`, the axes of its nodes, have to outlive it; `is_held` is as
/// above.
std::unique_ptr<MultigridLevel> make_multigrid(MpiRanks& ranks, const LevelMatrix<3>& matrix,
                                               std::vector<std::uint8_t> is_held, const NodeFrames& frames,
                                               CornerLevel corners);

}  // namespace kerf
