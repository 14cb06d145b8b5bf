// Held degrees of freedom stay in the matrix, so that nodes keep their numbers: their rows and columns become zero, the
// columns times the prescribed displacements go to the right side, and the mean of the diagonal takes their place on
// it. The matrix stays symmetric and positive definite. It is a sum of shares of the ranks: each rank takes the held
// ones out of its own blocks without a message, and the owner of a node alone writes its diagonal. For elements of
// order 2 the multigrid has the corners as a level of its own, whose stiffness is summed anew from straight elements of
// order 1 and held in the same way, with zero displacements.
#include "solve/equations/inside/held_stiffness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/core/ids.h"
#include "solve/equations/inside/block_rows.h"

namespace kerf {

namespace {

double mean_diagonal(const MpiRanks& ranks, const LevelMatrix<3>& matrix) {
    std::array<double, 2> sum = {0, static_cast<double>(matrix.owned_size())};
    for (std::int32_t n = 0; n < matrix.node_count(); ++n) sum[0] += matrix.share.block(matrix.share.first[n]).trace();
    ranks.all_reduce(std::span<double>(sum), Reduction::sum);
    return sum[0] / sum[1];
}

// Returns the largest sum of absolute values of a row.
double norm_of(const MpiRanks& ranks, const LevelMatrix<3>& matrix) {
    std::vector<double> sums(matrix.size(), 0);
    const SymmetricBlocks<3>& share = matrix.share;
    for (std::int32_t n = 0; n < share.row_count(); ++n)
        for (std::int64_t i = share.first[n]; i < share.first[n + 1]; ++i) {
            const std::int32_t m = share.columns[i];
            const Eigen::Matrix3d size = share.block(i).cwiseAbs();
            Eigen::Map<Vec3>(&sums[3 * n]) += size.rowwise().sum();
            if (m != n) Eigen::Map<Vec3>(&sums[3 * m]) += size.colwise().sum().transpose();
        }
    matrix.ownership.sum_to_owners(std::span(sums), 3);
    double largest = 0;
    for (std::size_t dof = 0; dof < matrix.owned_size(); ++dof) largest = std::max(largest, sums[dof]);
    return ranks.all_reduce(largest, Reduction::largest);
}

// Takes held rows and columns out of the matrix, to the right side.
void eliminate(SymmetricBlocks<3>& share, const std::vector<std::uint8_t>& is_held,
               const std::vector<double>& prescribed, std::vector<double>& of_prescribed) {
    for (std::int32_t n = 0; n < share.row_count(); ++n)
        for (std::int64_t i = share.first[n]; i < share.first[n + 1]; ++i) {
            const std::int32_t m = share.columns[i];
            auto block = share.block(i);
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c) {
                    const bool is_row_held = is_held[3 * n + r], is_column_held = is_held[3 * m + c];
                    if (!is_row_held && !is_column_held) continue;
                    if (!is_row_held) of_prescribed[3 * n + r] -= block(r, c) * prescribed[3 * m + c];
                    if (!is_column_held && m != n) of_prescribed[3 * m + c] -= block(r, c) * prescribed[3 * n + r];
                    block(r, c) = 0;
                }
        }
}

void put_on_diagonal(LevelMatrix<3>& matrix, const std::vector<std::uint8_t>& is_held, double value) {
    for (std::int32_t n = 0; n < matrix.owned; ++n)
        for (int c = 0; c < 3; ++c)
            if (is_held[3 * n + c]) matrix.share.block(matrix.share.first[n])(c, c) = value;
}

std::vector<std::uint8_t> held_flags(const ElasticProblem& problem) {
    std::vector<std::uint8_t> is_held(problem.support_of.size());
    for (std::size_t dof = 0; dof < is_held.size(); ++dof) is_held[dof] = problem.is_held(dof);
    return is_held;
}

// Appends the rows of a node, along its own axes: six columns, translations and turns about the axes.
void append_rigid_motions(NearNullSpace& motions, const ElasticProblem& problem, std::int32_t node) {
    const Vec3& p = problem.space->points()[node];
    RowMajorBlock<3, rigid_motions> rows;
    rows << 1, 0, 0, 0, p.z(), -p.y(), 0, 1, 0, -p.z(), 0, p.x(), 0, 0, 1, p.y(), -p.x(), 0;
    if (const NodeFrames::Frame* frame = problem.frames.at(node)) rows = (frame->axes * rows).eval();
    motions.insert(motions.end(), rows.data(), rows.data() + rows.size());
}

// The corners among the nodes of elements of order 2.
struct CornerNodes {
    std::vector<std::int32_t> number;  // of each local node; negative: a middle
    std::vector<std::int32_t> nodes;   // the local node of each corner
    std::vector<MiddleOf> middles;     // of each owned node
    std::int32_t owned = 0;            // number of owned corners
};

CornerNodes corners_of(const FeSpace& space) {
    CornerNodes found;
    found.number.assign(space.node_count(), -1);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        for (std::size_t i = 0; i < 4; ++i) found.number[nodes[i]] = 0;
    });
    for (std::int32_t n = 0; n < space.node_count(); ++n) {
        if (found.number[n] < 0) continue;
        found.number[n] = count_of(found.nodes);
        found.nodes.push_back(n);
        if (n < space.owned_count()) ++found.owned;
    }
    found.middles.resize(space.owned_count());
    for (std::int32_t n = 0; n < space.owned_count(); ++n) found.middles[n].ends[0] = found.number[n];
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        for (std::size_t e = 0; e < tet_edges.size(); ++e)
            if (const std::int32_t n = nodes[4 + e]; n < space.owned_count())
                found.middles[n].ends = {found.number[nodes[tet_edges[e][0]]], found.number[nodes[tet_edges[e][1]]]};
    });
    return found;
}

}  // namespace

HeldStiffness hold_stiffness(const ElasticProblem& problem, SymmetricBlocks<3> share) {
    const FeSpace& space = *problem.space;
    HeldStiffness held;
    held.matrix = {std::move(share), space.ownership(), space.owned_count()};
    held.diagonal = mean_diagonal(space.ranks(), held.matrix);
    held.of_prescribed.assign(held.matrix.size(), 0);
    const std::vector<std::uint8_t> is_held = held_flags(problem);
    eliminate(held.matrix.share, is_held, problem.prescribed, held.of_prescribed);
    put_on_diagonal(held.matrix, is_held, held.diagonal);
    held.norm = norm_of(space.ranks(), held.matrix);
    return held;
}

std::unique_ptr<MultigridLevel> multigrid_for(const ElasticProblem& problem, const HeldStiffness& stiffness,
                                              double mass_factor) {
    const FeSpace& space = *problem.space;
    const std::vector<std::uint8_t> is_held = held_flags(problem);
    NearNullSpace motions;
    if (space.order() == 1) {
        motions.reserve(18 * static_cast<std::size_t>(space.owned_count()));
        for (std::int32_t n = 0; n < space.owned_count(); ++n) append_rigid_motions(motions, problem, n);
        return make_multigrid(space.ranks(), stiffness.matrix, std::move(motions), is_held);
    }
    CornerNodes found = corners_of(space);
    CornerLevel corners;
    for (const std::int32_t n : found.nodes)
        for (int c = 0; c < 3; ++c) corners.is_held.push_back(is_held[3 * n + c]);
    for (std::int32_t n = 0; n < found.owned; ++n) append_rigid_motions(corners.motions, problem, found.nodes[n]);
    corners.matrix = {stiffness_of_rank(problem, {found.number, mass_factor}),
                      space.ownership().renumbered(found.number), found.owned};
    std::vector<double> unused(corners.matrix.size(), 0);
    eliminate(corners.matrix.share, corners.is_held, std::vector<double>(corners.matrix.size(), 0), unused);
    put_on_diagonal(corners.matrix, corners.is_held, stiffness.diagonal);
    corners.frames = problem.frames.renumbered(found.number);
    corners.middles = std::move(found.middles);
    return make_multigrid(space.ranks(), stiffness.matrix, is_held, problem.frames, std::move(corners));
}

}  // namespace kerf
