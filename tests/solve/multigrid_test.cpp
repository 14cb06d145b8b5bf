// Bodies that nothing couples with each other, as many as one likes: every test on all ranks together.
#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "cube_of_parts.h"
#include "solve/multigrid/multigrid.h"

namespace kerf {
namespace {

// Bars of two nodes each, held softly where they are. The first node of bar b is rank b's, the second the next rank's.
LevelMatrix<3> separate_bars(MpiRanks& ranks, int count) {
    using Block = LevelMatrix<3>::Block;
    const int own = ranks.rank(), size = ranks.size(), next = (own + 1) % size, last = (own + size - 1) % size;
    LevelMatrix<3> matrix;
    std::map<std::array<std::int32_t, 2>, std::int32_t> local;  // by bar and end
    Ownership::Neighbour of_last{last, {}}, of_next{next, {}};
    for (int b = 0; b < count; ++b) {
        if (b % size == own) local[{b, 0}] = matrix.owned++;
        if ((b + 1) % size != own) continue;
        if (size > 1) of_last.items.push_back(matrix.owned);
        local[{b, 1}] = matrix.owned++;
    }
    std::int32_t nodes = matrix.owned;
    for (int b = own; b < count && size > 1; b += size) {
        of_next.items.push_back(nodes);
        local[{b, 1}] = nodes++;
    }
    std::map<std::array<std::int32_t, 2>, Block> blocks;
    for (std::int32_t n = 0; n < nodes; ++n) blocks[{n, n}] = Block::Zero();
    for (int b = own; b < count; b += size) {
        const std::int32_t first = local[{b, 0}], second = local[{b, 1}];
        const Block stiff = (1 + b % 3) * Block::Identity(), soft = 1e-3 * Block::Identity();
        blocks[{first, first}] += stiff + soft;
        blocks[{second, second}] += stiff + soft;
        blocks[{std::min(first, second), std::max(first, second)}] = -stiff;
    }
    for (std::int32_t n = 0; n < nodes; ++n) {
        matrix.share.first.push_back(std::ssize(matrix.share.columns));
        for (auto at = blocks.lower_bound({n, n}); at != blocks.end() && at->first[0] == n; ++at) {
            matrix.share.columns.push_back(at->first[1]);
            const Block& block = at->second;
            matrix.share.values.insert(matrix.share.values.end(), block.data(), block.data() + block.size());
        }
    }
    matrix.share.first.push_back(std::ssize(matrix.share.columns));
    if (size > 1)
        matrix.ownership = {ranks, {std::move(of_last)}, {std::move(of_next)}};
    else
        matrix.ownership = {ranks, {}, {}};
    return matrix;
}

NearNullSpace translations(std::int32_t nodes) {
    NearNullSpace motions(3 * rigid_motions * static_cast<std::size_t>(nodes), 0);
    for (std::size_t n = 0; n < static_cast<std::size_t>(nodes); ++n)
        for (std::size_t c = 0; c < 3; ++c) motions[rigid_motions * (3 * n + c) + c] = 1;
    return motions;
}

class SeparateBodies : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, SeparateBodies, testing::Values(1, 60, 101, 5000));

// What is left of an error, in the norm of its energy, after one cycle.
TEST_P(SeparateBodies, AreSolvedTogether) {
    MpiRanks& ranks = *test::ranks_of_program->mpi;
    LevelMatrix<3> matrix = separate_bars(ranks, GetParam());
    const auto multigrid =
        make_multigrid(ranks, matrix, translations(matrix.owned), std::vector<std::uint8_t>(matrix.size(), 0));
    std::vector<double> x(matrix.size(), 0), of_x, correction(matrix.size(), 0), of_rest;
    for (std::size_t dof = 0; dof < matrix.owned_size(); ++dof)
        x[dof] = std::sin(static_cast<double>(dof + 1)) + (dof % 2 == 0 ? 1 : 0);
    matrix.multiply(x, of_x);
    multigrid->cycle(of_x, correction);
    std::vector<double> rest = x;
    for (std::size_t dof = 0; dof < matrix.owned_size(); ++dof) rest[dof] -= correction[dof];
    matrix.multiply(rest, of_rest);
    const double before = dot_of_owned(ranks, matrix.owned_size(), x, of_x);
    const double after = dot_of_owned(ranks, matrix.owned_size(), rest, of_rest);
    EXPECT_LT(after, 0.1 * before);
}

}  // namespace
}  // namespace kerf
