// The locally optimal block preconditioned conjugate gradient method (Knyazev 2001, knyazev2001) for A x = lambda B x.
// The basis of an iteration is [X P W]: X are the vectors so far, P the directions in which they moved last, and W the
// preconditioned residuals of those that are not found yet. The next X are the best vectors in its span, which solve a
// small dense problem with the Gram matrices of the basis. X and P are kept orthonormal in A (Hetmaniuk and Lehoucq
// 2006, hetmaniuk2006), so that only W can depend on the rest; such combinations, which are rounding, are dropped by
// eigenvalues of a scaled Gram matrix, in place of a Cholesky factorisation that may fail (Stathopoulos and Wu 2002,
// stathopoulos2002). Products with A and B are carried along as the basis is combined, and made anew every ten
// iterations and before the end, since rounding adds up.
#include "solve/multigrid/block_eigensolver.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "solve/multigrid/dense.h"

namespace kerf {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_of_unit = 1e-12;  // eigenvalues of a Gram matrix of unit vectors below it are of rounding
constexpr int products_last = 10;        // iterations
constexpr int patience = 5;              // iterations in which a residual halves, unless it is rounding

// Vectors x with their products A x and B x.
struct Basis {
    MatrixXd x, ax, bx;

    Eigen::Index size() const { return x.cols(); }
    Basis times(const MatrixXd& coefficients) const { return {x * coefficients, ax * coefficients, bx * coefficients}; }
};

// Returns T with T^T G T = 1, with a column for each independent combination.
MatrixXd orthonormalising(const MatrixXd& gram) {
    VectorXd scale(gram.cols());
    for (Eigen::Index i = 0; i < scale.size(); ++i) scale[i] = gram(i, i) > 0 ? 1 / std::sqrt(gram(i, i)) : 0;
    const SymmetricEigen axes = symmetric_eigen(scale.asDiagonal() * gram * scale.asDiagonal());
    Eigen::Index first = 0;
    while (first < axes.values.size() && !(axes.values[first] > least_of_unit)) ++first;
    const Eigen::Index kept = axes.values.size() - first;
    return scale.asDiagonal() * axes.vectors.rightCols(kept) *
           axes.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

class BlockEigensolver {
 public:
    BlockEigensolver(const MpiRanks& ranks, const EigenProblem& problem, const EigenGoal& goal)
        : ranks_(ranks), problem_(problem), goal_(goal) {}

    EigenPairs solve(const MatrixXd& start, const AfterEigenIteration& after_iteration);

 private:
    MatrixXd dot(const MatrixXd& a, const MatrixXd& b) const {
        MatrixXd sums = a.transpose() * b;
        ranks_.all_reduce(std::span(sums.data(), sums.size()), Reduction::sum);
        return sums;
    }
    MatrixXd applied(const EigenProblem::Apply& apply, const MatrixXd& to) const {
        MatrixXd result(to.rows(), to.cols());
        for (Eigen::Index c = 0; c < to.cols(); ++c) apply(to.col(c), result.col(c));
        return result;
    }
    Basis with_products(MatrixXd x) const {
        Basis basis;
        basis.ax = applied(problem_.multiply_a, x);
        basis.bx = applied(problem_.multiply_b, x);
        basis.x = std::move(x);
        return basis;
    }
    void make_orthonormal(Basis& basis) const { basis = basis.times(orthonormalising(dot(basis.x, basis.ax))); }
    void refresh();
    void measure();
    int count_found();
    Basis directions() const;
    void improve(const Basis& directions);

    const MpiRanks& ranks_;
    const EigenProblem& problem_;
    EigenGoal goal_;
    Basis now_, last_;         // X and P
    VectorXd inverse_;         // 1 / lambda of X, descending
    MatrixXd preconditioned_;  // residuals of X
    VectorXd residuals_;
    bool are_products_new_ = false;
    double halved_ = HUGE_VAL;  // the worst residual when it had halved last
    int since_halved_ = 0;      // iterations
};

// Makes the products of X and P anew, and chooses X once more.
void BlockEigensolver::refresh() {
    const Eigen::Index wanted = now_.size();
    MatrixXd all(now_.x.rows(), wanted + last_.size());
    all << now_.x, last_.x;
    now_ = with_products(std::move(all));
    make_orthonormal(now_);
    const SymmetricEigen axes = symmetric_eigen(dot(now_.x, now_.bx));
    const Eigen::Index found = axes.values.size(), kept = std::min(wanted, found);
    const MatrixXd order = axes.vectors.rowwise().reverse();
    last_ = now_.times(order.rightCols(found - kept));
    now_ = now_.times(order.leftCols(kept));
    inverse_ = axes.values.reverse().head(kept);
    are_products_new_ = true;
}

void BlockEigensolver::measure() {
    const MatrixXd rest = now_.bx - now_.ax * inverse_.asDiagonal();
    preconditioned_ = applied(problem_.precondition, rest);
    VectorXd squares = rest.cwiseProduct(preconditioned_).colwise().sum().transpose();
    ranks_.all_reduce(std::span(squares.data(), squares.size()), Reduction::sum);
    residuals_ = squares.cwiseMax(0).cwiseSqrt().cwiseQuotient(inverse_.cwiseMax(0));
}

// Returns W: the preconditioned residuals of vectors that are not found yet, orthogonal to X and P.
Basis BlockEigensolver::directions() const {
    MatrixXd w(now_.x.rows(), now_.size());
    Eigen::Index count = 0;
    for (Eigen::Index c = 0; c < now_.size(); ++c)
        if (!(residuals_[c] <= goal_.tolerance)) w.col(count++) = preconditioned_.col(c);
    w.conservativeResize(Eigen::NoChange, count);
    w -= now_.x * dot(now_.ax, w);
    if (last_.size() > 0) w -= last_.x * dot(last_.ax, w);
    const VectorXd squares = dot(w, w).diagonal();
    for (Eigen::Index c = 0; c < count; ++c)
        if (squares[c] > 0) w.col(c) /= std::sqrt(squares[c]);
    return with_products(std::move(w));
}

// Makes X the best vectors in the span of the basis, and P the motion from the old X to them.
void BlockEigensolver::improve(const Basis& directions) {
    const Eigen::Index sizes[] = {now_.size(), last_.size(), directions.size()};
    const Eigen::Index kept = sizes[0] + sizes[1], all = kept + sizes[2];
    MatrixXd gram_a = MatrixXd::Identity(all, all), gram_b = MatrixXd::Zero(all, all);
    const auto fill = [&](MatrixXd& gram, Eigen::Index row, const MatrixXd& block, Eigen::Index column) {
        gram.block(row, column, block.rows(), block.cols()) = block;
        gram.block(column, row, block.cols(), block.rows()) = block.transpose();
    };
    gram_b.topLeftCorner(sizes[0], sizes[0]) = inverse_.asDiagonal();
    if (sizes[1] > 0) {
        fill(gram_b, 0, dot(now_.bx, last_.x), sizes[0]);
        fill(gram_b, sizes[0], dot(last_.x, last_.bx), sizes[0]);
        fill(gram_a, sizes[0], dot(last_.ax, directions.x), kept);
        fill(gram_b, sizes[0], dot(last_.bx, directions.x), kept);
    }
    fill(gram_a, 0, dot(now_.ax, directions.x), kept);
    fill(gram_b, 0, dot(now_.bx, directions.x), kept);
    fill(gram_a, kept, dot(directions.x, directions.ax), kept);
    fill(gram_b, kept, dot(directions.x, directions.bx), kept);

    const MatrixXd independent = orthonormalising(gram_a);
    const SymmetricEigen axes = symmetric_eigen(independent.transpose() * gram_b * independent);
    const Eigen::Index found = std::min(sizes[0], axes.values.size());
    const MatrixXd best = independent * axes.vectors.rightCols(found).rowwise().reverse();
    inverse_ = axes.values.tail(found).reverse();
    MatrixXd moved = best;
    moved.topRows(sizes[0]).setZero();
    moved -= best * (best.transpose() * gram_a * moved);
    moved = (moved * orthonormalising(moved.transpose() * gram_a * moved)).eval();
    const auto combine = [&](const MatrixXd Basis::*part) {
        MatrixXd result = now_.*part * best.topRows(sizes[0]) + directions.*part * best.bottomRows(sizes[2]);
        MatrixXd motion = now_.*part * moved.topRows(sizes[0]) + directions.*part * moved.bottomRows(sizes[2]);
        if (sizes[1] > 0) {
            result += last_.*part * best.middleRows(sizes[0], sizes[1]);
            motion += last_.*part * moved.middleRows(sizes[0], sizes[1]);
        }
        return std::pair(std::move(result), std::move(motion));
    };
    Basis next, motions;
    std::tie(next.x, motions.x) = combine(&Basis::x);
    std::tie(next.ax, motions.ax) = combine(&Basis::ax);
    std::tie(next.bx, motions.bx) = combine(&Basis::bx);
    now_ = std::move(next);
    last_ = std::move(motions);
    are_products_new_ = false;
}

// Returns how many of the first pairs reach the tolerance, or reach EigenGoal::of_rounding times it where rounding
// keeps them from it.
int BlockEigensolver::count_found() {
    const double worst = residuals_.head(goal_.count).maxCoeff();
    if (!(worst > 0.5 * halved_)) {
        halved_ = worst;
        since_halved_ = 0;
    } else {
        ++since_halved_;
    }
    const double allowed = goal_.tolerance * (since_halved_ > patience ? EigenGoal::of_rounding : 1);
    int found = 0;
    while (found < goal_.count && residuals_[found] <= allowed) ++found;
    return found;
}

EigenPairs BlockEigensolver::solve(const MatrixXd& start, const AfterEigenIteration& after_iteration) {
    EigenPairs pairs;
    now_.x = applied(problem_.precondition, applied(problem_.multiply_b, start));
    last_.x.resize(start.rows(), 0);
    refresh();
    for (;;) {
        measure();
        pairs.converged = count_found();
        if (after_iteration) after_iteration(pairs.iterations, pairs.converged);
        const bool is_done = pairs.converged == goal_.count || pairs.iterations == goal_.most_iterations ||
                             since_halved_ > 10 * patience;
        if (is_done && are_products_new_) break;
        if (is_done || pairs.iterations % products_last == products_last - 1) {
            refresh();
            if (is_done) continue;
            measure();
        }
        improve(directions());
        ++pairs.iterations;
    }
    pairs.values = inverse_.cwiseInverse();
    pairs.vectors = std::move(now_.x);
    pairs.residuals = residuals_;
    return pairs;
}

}  // namespace

EigenPairs smallest_eigenpairs(const MpiRanks& ranks, const EigenProblem& problem, const EigenGoal& goal,
                               const MatrixXd& start, const AfterEigenIteration& after_iteration) {
    return BlockEigensolver(ranks, problem, goal).solve(start, after_iteration);
}

}  // namespace kerf
