// One step of a multigrid: from a level to the next coarser one.
#pragma once

#include <cstdint>
#include <vector>

#include "base/core/ids.h"
#include "solve/multigrid/inside/chebyshev_smoother.h"
#include "solve/multigrid/level_matrix.h"
#include "solve/multigrid/symmetric_blocks.h"

namespace kerf {

/// The count of numbers at a node of a coarse level, which are amounts of rigid motions.
inline constexpr int rigid_motions = 6;

/// A sparse matrix of blocks: row n of the fine level has a block for each of the coarse nodes columns[first[n]] to
/// columns[first[n + 1] - 1]. Blocks have single precision: the coarse matrix is made with the same ones, so that
/// nothing is lost by that.
template <int B>
struct Prolongation {
    using Block = RowMajorBlock<B, rigid_motions, float>;
    static constexpr int block_size = B * rigid_motions;

    std::vector<std::int64_t> first{0};
    std::vector<std::int32_t> columns;
    std::vector<float> values;

    std::int32_t row_count() const { return count_of(first) - 1; }
    RowMajorBlock<B, rigid_motions> block(std::int64_t at) const {
        return Eigen::Map<const Block>(&values[block_size * at]).template cast<double>();
    }
    /// Adds P coarse to the first `rows` rows of `fine`.
    void prolong(const std::vector<double>& coarse, std::vector<double>& fine, std::int32_t rows) const {
        for (std::int32_t n = 0; n < rows; ++n)
            for (std::int64_t i = first[n]; i < first[n + 1]; ++i)
                Eigen::Map<Eigen::Matrix<double, B, 1>>(&fine[B * n]).noalias() +=
                    block(i) *
                    Eigen::Map<const Eigen::Matrix<double, rigid_motions, 1>>(&coarse[rigid_motions * columns[i]]);
    }
    /// Adds P^T fine, of the first `rows` rows of `fine`, to `coarse`.
    void restrict_to(const std::vector<double>& fine, std::vector<double>& coarse, std::int32_t rows) const {
        for (std::int32_t n = 0; n < rows; ++n)
            for (std::int64_t i = first[n]; i < first[n + 1]; ++i)
                Eigen::Map<Eigen::Matrix<double, rigid_motions, 1>>(&coarse[rigid_motions * columns[i]]).noalias() +=
                    block(i).transpose() * Eigen::Map<const Eigen::Matrix<double, B, 1>>(&fine[B * n]);
    }
};

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
