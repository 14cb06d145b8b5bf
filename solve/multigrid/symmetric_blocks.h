// A sparse symmetric matrix of small blocks over the local nodes of a rank.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "base/core/ids.h"

namespace kerf {

/// A block as it lies in an array, row by row.
template <int Rows, int Columns, class Number = double>
using RowMajorBlock = Eigen::Matrix<Number, Rows, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// A sparse symmetric matrix of B x B blocks. Row n has the blocks of columns[first[n]] to columns[first[n + 1] - 1],
/// ascending from the diagonal on, which is always there. Blocks below the diagonal are the transposes of those above
/// it.
template <int B>
struct SymmetricBlocks {
    using Block = RowMajorBlock<B, B>;

    std::vector<std::int64_t> first;
    std::vector<std::int32_t> columns;
    std::vector<double> values;  ///< B * B of each block, row by row

    std::int32_t row_count() const { return count_of(first) - 1; }
    Eigen::Map<Block> block(std::int64_t at) { return Eigen::Map<Block>(&values[B * B * at]); }
    Eigen::Map<const Block> block(std::int64_t at) const { return Eigen::Map<const Block>(&values[B * B * at]); }

    /// Adds A x to y, with B numbers of each node, to the precision of Number. O(blocks).
    template <class Number>
    void multiply_add(std::span<const Number> x, std::span<Number> y) const {
        using Vector = Eigen::Matrix<Number, B, 1>;
        for (std::int32_t n = 0; n < row_count(); ++n) {
            const Vector of_row = Eigen::Map<const Vector>(&x[B * n]);
            Vector sum = block(first[n]).template cast<Number>() * of_row;
            for (std::int64_t i = first[n] + 1; i < first[n + 1]; ++i) {
                const auto a = block(i).template cast<Number>();
                sum.noalias() += a * Eigen::Map<const Vector>(&x[B * columns[i]]);
                Eigen::Map<Vector>(&y[B * columns[i]]).noalias() += a.transpose() * of_row;
            }
            Eigen::Map<Vector>(&y[B * n]) += sum;
        }
    }
};

/// The blocks below the diagonal: row n has the transposes of blocks at[i] in rows[i], for i from first[n] to
/// first[n + 1] - 1, ascending.
struct LowerBlocks {
    std::vector<std::int64_t> first;
    std::vector<std::int32_t> rows;
    std::vector<std::int64_t> at;
};

template <int B>
LowerBlocks lower_blocks_of(const SymmetricBlocks<B>& upper) {
    LowerBlocks lower;
    lower.first.assign(upper.row_count() + 2, 0);
    for (std::int32_t n = 0; n < upper.row_count(); ++n)
        for (std::int64_t i = upper.first[n] + 1; i < upper.first[n + 1]; ++i) ++lower.first[upper.columns[i] + 2];
    for (std::size_t n = 1; n < lower.first.size(); ++n) lower.first[n] += lower.first[n - 1];
    lower.rows.resize(lower.first.back());
    lower.at.resize(lower.first.back());
    for (std::int32_t n = 0; n < upper.row_count(); ++n)
        for (std::int64_t i = upper.first[n] + 1; i < upper.first[n + 1]; ++i) {
            const std::int64_t place = lower.first[upper.columns[i] + 1]++;
            lower.rows[place] = n;
            lower.at[place] = i;
        }
    lower.first.pop_back();
    return lower;
}

}  // namespace kerf
