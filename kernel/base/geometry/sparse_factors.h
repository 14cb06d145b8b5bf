// Solutions of sparse symmetric equations.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "base/core/cancellation.h"

namespace kerf {

/// An entry of a sparse matrix. Entries at the same place are added, in their order.
struct SparseEntry {
    std::int32_t row, column;
    double value;
};

/// The factors L D L^T of a symmetric matrix, whose rows are put into an order that leaves L sparse. Deterministic.
class SparseFactors {
 public:
    /// The factors of a matrix without rows.
    SparseFactors();
    /// Factorises a matrix; entries above the diagonal are not read. `check_cancelled` is called before each step and
    /// at the end.
    SparseFactors(std::int64_t size, const std::vector<SparseEntry>& entries,
                  const CancellationCheck& check_cancelled = {});
    SparseFactors(SparseFactors&&) noexcept;
    SparseFactors& operator=(SparseFactors&&) noexcept;
    ~SparseFactors();

    /// Whether the matrix is positive definite, without which the factors are of no use. True for a matrix without
    /// rows.
    bool are_positive() const;
    /// Solves the equations; `right` has a number for each row, of which there must be one at least.
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

/// Returns how many numbers the factor L of such a matrix has, from the places of the entries alone, not their values.
/// Takes about the time of a pass over L, without the memory of L.
std::int64_t factor_size(std::int64_t size, const std::vector<SparseEntry>& entries);

/// A matrix with a row for each point.
using PointRows = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Returns the x, with `unknown` rows, for which the sum of weight |A x + known|^2 over the rows of A is least, by its
/// normal equations; x has no rows if these cannot be factorised. `weight` and `known` have a row for each row of A.
/// Deterministic.
PointRows least_squares(std::int64_t unknown, const std::vector<SparseEntry>& entries, const Eigen::VectorXd& weight,
                        const PointRows& known);

}  // namespace kerf
