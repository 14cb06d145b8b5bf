// The lowest eigenvalues of a pair of large symmetric matrices, by blocks.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "base/mpi/mpi_ranks.h"

namespace kerf {

/// The problem A x = lambda B x with A positive definite and B not negative. Vectors have the entries that this rank
/// owns. The calls are collective; their second argument is the result, as large as the first.
struct EigenProblem {
    using Apply = std::function<void(const Eigen::VectorXd&, Eigen::Ref<Eigen::VectorXd>)>;

    Apply multiply_a, multiply_b;
    Apply precondition;  ///< a fixed symmetric approximation of the inverse of A
};

struct EigenGoal {
    int count = 1;
    double tolerance = 1e-5;  ///< for EigenPairs::residuals
    /// Pairs whose residuals no longer fall count as found up to this multiple of the tolerance: the rest is rounding.
    static constexpr double of_rounding = 10;
    int most_iterations = 1000;
};

struct EigenPairs {
    Eigen::VectorXd values;     ///< lambda, ascending; as many as the start has columns
    Eigen::MatrixXd vectors;    ///< a column each, with x^T A x = 1
    Eigen::VectorXd residuals;  ///< |A x - lambda B x| over |A x|, in the norm of the inverse of A as preconditioned
    int converged = 0;          ///< number of pairs, from the first on, that reach the tolerance
    int iterations = 0;
};

/// Called after each iteration, on every rank, with its number and the number of pairs found. Must not throw.
using AfterEigenIteration = std::function<void(int iteration, int found)>;

/// Returns the lowest eigenvalues and their vectors by LOBPCG (knyazev2001) on the inverted problem B x = A x / lambda:
/// vectors are orthonormal in A (hetmaniuk2006), and those that depend on others are dropped (stathopoulos2002), so
/// that no factorisation can fail and, of eigenvalues that lie up to 1e14 apart, the lowest are the most exact.
/// Residuals in the norm of the inverse of A bound the relative error of a value by about their square; rounding in A,
/// which is felt at the other end of its spectrum, hardly shows in them. `start`: a column for each vector of the
/// block, more than the goal's count, since the last converge slowly. Collective; O(count) products and
/// preconditionings each iteration. Bytes are the same for the same number of ranks.
EigenPairs smallest_eigenpairs(const MpiRanks& ranks, const EigenProblem& problem, const EigenGoal& goal,
                               const Eigen::MatrixXd& start, const AfterEigenIteration& after_iteration = {});

}  // namespace kerf
