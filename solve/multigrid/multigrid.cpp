// A V-cycle over three kinds of levels. `MiddlesLevel`, of elements of order 2, smooths and corrects by their corners,
// between which it interpolates (p-multigrid: Ronquist and Patera 1987, ronquist1987). `SmoothedLevel` smooths and
// corrects by the next coarser level, of aggregates (solve/multigrid/inside/smoothed_aggregation.h). `CoarsestLevel`
// gathers the matrix and factorises it on every rank. Coarsening ends at few nodes, where it makes no fewer nodes, or
// where factors have hardly more numbers than the matrix: a slender body is such a chain of nodes, and smoother and
// aggregates of aggregates see its bending ever worse. A cycle is a fixed symmetric operator, as conjugate gradients
// need: the smoother is the same before and after, and restriction is the transpose of prolongation. B is the number of
// unknowns of a node: 3 displacements, or 6 rigid motions of an aggregate; nodes of which everything is held are in no
// aggregate (`is_apart`).
#include "solve/multigrid/multigrid.h"

#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/geometry/sparse_factors.h"

namespace kerf {

namespace {

constexpr std::int64_t few_nodes = 100;
constexpr std::int64_t nodes_to_analyse = 5000;  // about as many as every rank can have without noticing
constexpr std::int64_t little_fill = 3;

// The numbers of the local nodes among the nodes of all ranks, in their order.
struct GlobalNumbers {
    std::int64_t before = 0, all = 0;  // numbers of nodes: of earlier ranks, of all ranks
    std::vector<std::int64_t> of_node;
};

template <int B>
GlobalNumbers global_numbers(MpiRanks& ranks, const LevelMatrix<B>& matrix) {
    GlobalNumbers numbers;
    const std::vector<std::int64_t> owned = all_gather<std::int64_t>(ranks, matrix.owned);
    for (int r = 0; r < count_of(owned); ++r) {
        if (r < ranks.rank()) numbers.before += owned[r];
        numbers.all += owned[r];
    }
    numbers.of_node.resize(matrix.node_count());
    for (std::int32_t n = 0; n < matrix.owned; ++n) numbers.of_node[n] = numbers.before + n;
    matrix.ownership.from_owners(std::span(numbers.of_node), 1);
    return numbers;
}

// The coarsest level, factorised on every rank: the shares of all ranks are gathered.
template <int B>
class CoarsestLevel : public MultigridLevel {
 public:
    CoarsestLevel(MpiRanks& ranks, const LevelMatrix<B>& matrix) : ranks_(ranks), size_(matrix.owned_size()) {
        const GlobalNumbers numbers = global_numbers(ranks, matrix);
        first_ = B * numbers.before;
        right_.resize(B * numbers.all);
        factorise(gathered(matrix, numbers.of_node));
    }
    void cycle(const std::vector<double>& right, std::vector<double>& x) override {
        right_.setZero();
        std::copy_n(right.begin(), size_, right_.data() + first_);
        ranks_.all_reduce(std::span(right_.data(), right_.size()), Reduction::sum);
        if (right_.size() == 0) return;
        const Eigen::VectorXd solution = factors_.solve(right_);
        std::copy_n(solution.data() + first_, size_, x.begin());
    }

 private:
    // A block of the matrix, with the numbers of its nodes.
    struct GatheredBlock {
        std::array<std::int64_t, 2> nodes{};
        std::array<double, B * B> values{};

        template <class Archive>
        void archive(Archive& a) {
            a(nodes, values);
        }
    };
    // Returns the blocks of all ranks.
    std::vector<GatheredBlock> gathered(const LevelMatrix<B>& matrix, const std::vector<std::int64_t>& number) {
        std::vector<GatheredBlock> own;
        for (std::int32_t n = 0; n < matrix.node_count(); ++n)
            for (std::int64_t i = matrix.share.first[n]; i < matrix.share.first[n + 1]; ++i) {
                GatheredBlock& block = own.emplace_back();
                block.nodes = {number[n], number[matrix.share.columns[i]]};
                std::copy_n(&matrix.share.values[B * B * i], B * B, block.values.begin());
            }
        return gather_items(ranks_, own);
    }
    void factorise(const std::vector<GatheredBlock>& blocks) {
        std::vector<SparseEntry> entries;
        std::vector<double> diagonal(right_.size(), 0);
        for (const GatheredBlock& block : blocks) {
            const int row = block.nodes[0], column = block.nodes[1];
            for (int i = 0; i < B; ++i)
                for (int j = 0; j < B; ++j) {
                    const double value = block.values[B * i + j];
                    const int r = B * row + i, c = B * column + j;
                    if (r == c) diagonal[r] += value;
                    if (row == column ? r >= c : true) entries.push_back({std::max(r, c), std::min(r, c), value});
                }
        }
        for (int i = 0; i < count_of(diagonal); ++i)  // nothing acts on these
            if (diagonal[i] == 0) entries.push_back({i, i, 1.0});
        if (right_.size() > 0) factors_ = SparseFactors(right_.size(), entries);
        if (!factors_.are_positive())
            throw Error(ErrorCode::convergence,
                        "The coarsest equations of the multigrid are not positive definite: what holds the body, or a "
                        "stiffness beside others, is lost in rounding. Hold it at more places, bring the materials "
                        "nearer to each other, or try preconditioner = \"icc\".");
    }

    MpiRanks& ranks_;
    std::size_t size_, first_ = 0;
    Eigen::VectorXd right_;
    SparseFactors factors_;
};

// Returns whether factors have hardly more numbers than the matrix, as those of a chain of nodes: of a slender body,
// whose bending smoother and aggregates of aggregates see ever worse.
template <int B>
bool is_quick_to_factorise(MpiRanks& ranks, const LevelMatrix<B>& matrix, std::int64_t nodes) {
    if (nodes > nodes_to_analyse) return false;
    const GlobalNumbers numbers = global_numbers(ranks, matrix);
    std::vector<std::array<std::int64_t, 2>> own;
    for (std::int32_t n = 0; n < matrix.node_count(); ++n)
        for (std::int64_t i = matrix.share.first[n]; i < matrix.share.first[n + 1]; ++i)
            own.push_back({numbers.of_node[n], numbers.of_node[matrix.share.columns[i]]});
    std::vector<SparseEntry> entries;
    for (const auto& [n, m] : gather_items(ranks, own)) {
        const std::int32_t row = std::max(n, m), column = std::min(n, m);
        entries.push_back({row, column, 1.0});
    }
    return factor_size(nodes, entries) <= little_fill * std::ssize(entries);
}

template <int B>
std::unique_ptr<MultigridLevel> make_level(MpiRanks& ranks, const LevelMatrix<B>& matrix, const NearNullSpace& motions,
                                           const std::vector<std::uint8_t>& is_apart);

template <int B>
class SmoothedLevel : public MultigridLevel {
 public:
    SmoothedLevel(MpiRanks& ranks, const LevelMatrix<B>& matrix, ChebyshevSmoother<B> smoother, CoarserLevel<B> coarser)
        : matrix_(matrix),
          smoother_(std::move(smoother)),
          prolongation_(std::move(coarser.prolongation)),
          coarser_(std::move(coarser.matrix)),
          next_(make_level(ranks, coarser_, coarser.motions, std::vector<std::uint8_t>(coarser_.owned, 0))),
          coarse_right_(coarser_.size()),
          coarse_x_(coarser_.size()) {}
    void cycle(const std::vector<double>& right, std::vector<double>& x) override {
        std::fill(x.begin(), x.end(), 0);
        smoother_.smooth(right, x, true);
        matrix_.multiply(x, rest_);
        for (std::size_t i = 0; i < matrix_.owned_size(); ++i) rest_[i] = right[i] - rest_[i];
        std::fill(coarse_right_.begin(), coarse_right_.end(), 0);
        prolongation_.restrict_to(rest_, coarse_right_, matrix_.owned);
        coarser_.ownership.sum_to_owners(std::span(coarse_right_), rigid_motions);
        next_->cycle(coarse_right_, coarse_x_);
        coarser_.ownership.from_owners(std::span(coarse_x_), rigid_motions);
        prolongation_.prolong(coarse_x_, x, matrix_.owned);
        smoother_.smooth(right, x, false);
    }

 private:
    const LevelMatrix<B>& matrix_;
    ChebyshevSmoother<B> smoother_;
    Prolongation<B> prolongation_;
    LevelMatrix<rigid_motions> coarser_;
    std::unique_ptr<MultigridLevel> next_;
    std::vector<double> coarse_right_, coarse_x_, rest_;
};

template <int B>
std::unique_ptr<MultigridLevel> make_level(MpiRanks& ranks, const LevelMatrix<B>& matrix, const NearNullSpace& motions,
                                           const std::vector<std::uint8_t>& is_apart) {
    const auto nodes_of = [&](const auto& level) {
        return ranks.all_reduce<std::int64_t>(level.owned, Reduction::sum);
    };
    // Each rank has an aggregate at least: more ranks need more nodes.
    const std::int64_t nodes = nodes_of(matrix);
    if (nodes <= std::max<std::int64_t>(few_nodes, 4 * ranks.size()) || is_quick_to_factorise(ranks, matrix, nodes))
        return std::make_unique<CoarsestLevel<B>>(ranks, matrix);
    ChebyshevSmoother<B> smoother(matrix);
    CoarserLevel<B> coarser = coarsen(ranks, matrix, smoother, motions, is_apart);
    if (nodes_of(coarser.matrix) == nodes) return std::make_unique<CoarsestLevel<B>>(ranks, matrix);
    return std::make_unique<SmoothedLevel<B>>(ranks, matrix, std::move(smoother), std::move(coarser));
}

// Returns a flag for each node: whether nothing of it is free.
std::vector<std::uint8_t> held_nodes(const std::vector<std::uint8_t>& is_held) {
    std::vector<std::uint8_t> held(is_held.size() / 3);
    for (std::size_t n = 0; n < held.size(); ++n) held[n] = is_held[3 * n] && is_held[3 * n + 1] && is_held[3 * n + 2];
    return held;
}

void hold(NearNullSpace& motions, const std::vector<std::uint8_t>& is_held) {
    for (std::size_t dof = 0; rigid_motions * dof < motions.size(); ++dof)
        if (is_held[dof]) std::fill_n(&motions[rigid_motions * dof], rigid_motions, 0);
}

void drop_held(const std::vector<std::uint8_t>& is_held, std::vector<double>& values) {
    for (std::size_t dof = 0; dof < is_held.size(); ++dof)
        if (is_held[dof]) values[dof] = 0;
}

// The level of elements of order 2 above those of order 1. Between the two levels vectors are along x, y and z.
class MiddlesLevel : public MultigridLevel {
 public:
    MiddlesLevel(MpiRanks& ranks, const LevelMatrix<3>& matrix, std::vector<std::uint8_t> is_held,
                 const NodeFrames& frames, CornerLevel corners)
        : matrix_(matrix),
          smoother_(matrix),
          is_held_(std::move(is_held)),
          frames_(frames),
          corners_(std::move(corners)),
          next_(make_multigrid(ranks, corners_.matrix, std::move(corners_.motions), corners_.is_held)),
          coarse_right_(corners_.matrix.size()),
          coarse_x_(corners_.matrix.size()) {}

    void cycle(const std::vector<double>& right, std::vector<double>& x) override {
        std::fill(x.begin(), x.end(), 0);
        smoother_.smooth(right, x, true);
        matrix_.multiply(x, rest_);
        for (std::size_t i = 0; i < matrix_.owned_size(); ++i) rest_[i] = right[i] - rest_[i];
        to_corners();
        next_->cycle(coarse_right_, coarse_x_);
        from_corners();
        for (std::size_t i = 0; i < matrix_.owned_size(); ++i) x[i] += rest_[i];
        smoother_.smooth(right, x, false);
    }

 private:
    // The transpose of from_corners().
    void to_corners() {
        drop_held(is_held_, rest_);
        frames_.from_frames(owned_rest());
        std::fill(coarse_right_.begin(), coarse_right_.end(), 0);
        for_all_ends([&](std::size_t fine, std::size_t coarse, double weight) {
            coarse_right_[coarse] += weight * rest_[fine];
        });
        corners_.frames.to_frames(coarse_right_);
        drop_held(corners_.is_held, coarse_right_);
        corners_.matrix.ownership.sum_to_owners(std::span(coarse_right_), 3);
    }
    void from_corners() {
        corners_.matrix.ownership.from_owners(std::span(coarse_x_), 3);
        drop_held(corners_.is_held, coarse_x_);
        corners_.frames.from_frames(coarse_x_);
        std::fill(rest_.begin(), rest_.end(), 0);
        for_all_ends(
            [&](std::size_t fine, std::size_t coarse, double weight) { rest_[fine] += weight * coarse_x_[coarse]; });
        frames_.to_frames(owned_rest());
        drop_held(is_held_, rest_);
    }
    std::span<double> owned_rest() { return std::span(rest_).first(matrix_.owned_size()); }
    // Calls visit(component of a node here, component of a corner, weight).
    template <class Visit>
    void for_all_ends(Visit visit) const {
        for (std::size_t n = 0; n < corners_.middles.size(); ++n) {
            const auto [a, b] = corners_.middles[n].ends;
            for (std::size_t c = 0; c < 3; ++c) {
                visit(3 * n + c, 3 * a + c, b < 0 ? 1 : 0.5);
                if (b >= 0) visit(3 * n + c, 3 * b + c, 0.5);
            }
        }
    }

    const LevelMatrix<3>& matrix_;
    ChebyshevSmoother<3> smoother_;
    std::vector<std::uint8_t> is_held_;
    const NodeFrames& frames_;
    CornerLevel corners_;
    std::unique_ptr<MultigridLevel> next_;
    std::vector<double> rest_, coarse_right_, coarse_x_;
};

}  // namespace

std::unique_ptr<MultigridLevel> make_multigrid(MpiRanks& ranks, const LevelMatrix<3>& matrix, NearNullSpace motions,
                                               const std::vector<std::uint8_t>& is_held) {
    hold(motions, is_held);
    return make_level(ranks, matrix, motions, held_nodes(is_held));
}

std::unique_ptr<MultigridLevel> make_multigrid(MpiRanks& ranks, const LevelMatrix<3>& matrix,
                                               std::vector<std::uint8_t> is_held, const NodeFrames& frames,
                                               CornerLevel corners) {
    return std::make_unique<MiddlesLevel>(ranks, matrix, std::move(is_held), frames, std::move(corners));
}

}  // namespace kerf
