// One step of a multigrid: from a level to the next coarser one.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/multigrid/inside/chebyshev_smoother.h"
#include "solve/multigrid/inside/prolongation.h"
#include "solve/multigrid/level_matrix.h"

namespace kerf {

/// The motions that a matrix hardly resists: for each owned node B rows of six numbers, the rigid motions.
using NearNullSpace = std::vector<double>;

/// The next coarser level: rigid motions of aggregates, smoothed by one step of Jacobi's method (Vanek, Mandel and
/// Brezina 1996, vanek1996).
template <int B>
struct CoarserLevel {
    Prolongation<B> prolongation;       ///< its rows are owned nodes
    LevelMatrix<rigid_motions> matrix;  ///< P^T A P
    NearNullSpace motions;              ///< of the coarse nodes
};

/// Makes the next coarser level. Collective. Aggregates do not cross ranks, but everything else does, so that the
/// result hardly depends on their number. Nodes of `is_apart`, and nodes that are coupled with no other one, have no
/// part in the coarse level. It may have as many nodes as the fine one: where each node is coupled with nodes of other
/// ranks alone. O(n).
template <int B>
CoarserLevel<B> coarsen(MpiRanks& ranks, const LevelMatrix<B>& fine, const ChebyshevSmoother<B>& smoother,
                        const NearNullSpace& motions, const std::vector<std::uint8_t>& is_apart);

extern template CoarserLevel<3> coarsen(MpiRanks&, const LevelMatrix<3>&, const ChebyshevSmoother<3>&,
                                        const NearNullSpace&, const std::vector<std::uint8_t>&);
extern template CoarserLevel<6> coarsen(MpiRanks&, const LevelMatrix<6>&, const ChebyshevSmoother<6>&,
                                        const NearNullSpace&, const std::vector<std::uint8_t>&);

}  // namespace kerf
