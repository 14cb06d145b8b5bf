// One step of a multigrid: from a level to the next coarser one.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/chebyshev_smoother.h"
#include "solve/level_matrix.h"
#include "solve/prolongation.h"

namespace kerf {

/// What a matrix hardly resists: for each owned node B rows of six numbers, the rigid motions.
using NearNullSpace = std::vector<double>;

/// Vanek, Mandel, Brezina 1996: rigid motions of aggregates, smoothed by one step of Jacobi's method.
template <int B>
struct CoarserLevel {
    Prolongation<B> prolongation;       ///< of owned nodes
    LevelMatrix<rigid_motions> matrix;  ///< P^T A P
    NearNullSpace motions;              ///< there
};

/// Collective. Aggregates do not cross ranks; all else does, so that the result hardly depends on their number. Nodes
/// of `is_apart`, and nodes that nothing couples with another one, have no part in what is coarse. There may be as many
/// coarse nodes as there were: where a node is coupled with nodes of other ranks alone. O(n).
template <int B>
CoarserLevel<B> coarsen(MpiRanks& ranks, const LevelMatrix<B>& fine, const ChebyshevSmoother<B>& smoother,
                        const NearNullSpace& motions, const std::vector<std::uint8_t>& is_apart);

extern template CoarserLevel<3> coarsen(MpiRanks&, const LevelMatrix<3>&, const ChebyshevSmoother<3>&,
                                        const NearNullSpace&, const std::vector<std::uint8_t>&);
extern template CoarserLevel<6> coarsen(MpiRanks&, const LevelMatrix<6>&, const ChebyshevSmoother<6>&,
                                        const NearNullSpace&, const std::vector<std::uint8_t>&);

}  // namespace kerf
