// A symmetric matrix that is distributed over ranks as a sum of shares.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "base/mpi/ownership.h"
#include "solve/multigrid/dense.h"
#include "solve/multigrid/symmetric_blocks.h"

namespace kerf {

/// The sum over the ranks of `share`, whose local nodes are those that a rank owns, then its ghosts. Vectors have B
/// numbers for each local node. The sum is never assembled over ranks: a product takes the values of ghosts and adds
/// its results for them to those of their owners, rank after rank, so that its bytes are the same each time.
template <int B>
struct LevelMatrix {
    using Block = typename SymmetricBlocks<B>::Block;

    SymmetricBlocks<B> share;
    Ownership ownership;
    std::int32_t owned = 0;

    std::int32_t node_count() const { return share.row_count(); }
    std::size_t owned_size() const { return static_cast<std::size_t>(B) * owned; }
    std::size_t size() const { return static_cast<std::size_t>(B) * node_count(); }

    /// Sets y = A x for the owned nodes, to the precision of Number; ghosts of x get their owners' values. Collective.
    template <class Number>
    void multiply(std::vector<Number>& x, std::vector<Number>& y) const {
        ownership.from_owners(std::span(x), B);
        y.assign(size(), 0);
        share.template multiply_add<Number>(x, y);
        ownership.sum_to_owners(std::span(y), B);
    }
    /// Returns the blocks of the diagonal of owned nodes. Collective.
    std::vector<double> diagonal() const {
        std::vector<double> blocks(size() * B);
        for (std::int32_t n = 0; n < node_count(); ++n)
            std::copy_n(&share.values[B * B * share.first[n]], B * B, &blocks[B * B * n]);
        ownership.sum_to_owners(std::span(blocks), B * B);
        blocks.resize(owned_size() * B);
        return blocks;
    }
    /// Returns the inverses of the blocks of the diagonal. A zero on the diagonal counts as 1: nothing acts on that
    /// degree of freedom. Collective.
    std::vector<double> inverse_diagonal() const {
        std::vector<double> blocks = diagonal();
        for (std::int32_t n = 0; n < owned; ++n) {
            Eigen::Map<Block> block(&blocks[B * B * n]);
            for (int i = 0; i < B; ++i)
                if (block(i, i) == 0) block(i, i) = 1;
            invert<B>(block);
        }
        return blocks;
    }
};

/// Returns the scalar product of two vectors over all ranks, of the entries that each owns. Collective.
inline double dot_of_owned(const MpiRanks& ranks, std::size_t owned_size, const std::vector<double>& a,
                           const std::vector<double>& b) {
    const Eigen::Index size = owned_size;
    const double own =
        Eigen::Map<const Eigen::VectorXd>(a.data(), size).dot(Eigen::Map<const Eigen::VectorXd>(b.data(), size));
    return ranks.all_reduce(own, Reduction::sum);
}

}  // namespace kerf
