// The prolongation from a coarse level of a multigrid to the finer one.
#pragma once

#include <cstdint>
#include <vector>

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

    std::int32_t row_count() const { return static_cast<std::int32_t>(first.size()) - 1; }
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

}  // namespace kerf
