// Sparse symmetric equations.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/cancellation.h"

namespace kerf {

/// An entry of a sparse matrix. Entries of the same place are added, in their order.
struct SparseEntry {
    std::int32_t row, column;
    double value;
};

/// The factors L D L^T of a symmetric matrix, its rows in an order that leaves L sparse. Deterministic.
class SparseFactors {
 public:
    /// Of a matrix without rows.
    SparseFactors();
    /// What `entries` have above the diagonal is not read. `check_cancelled` is called before each step and at the end.
    SparseFactors(std::int64_t size, const std::vector<SparseEntry>& entries,
                  const CancellationCheck& check_cancelled = {});
    SparseFactors(SparseFactors&&) noexcept;
    SparseFactors& operator=(SparseFactors&&) noexcept;
    ~SparseFactors();

    /// Whether the matrix is positive definite: else the factors are of no use. True without rows.
    bool are_positive() const;
    /// `right` has a number for each row, of which there is one at least.
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

/// So many numbers the factor L of such a matrix has, as `entries` say which are not zero; their values do not matter.
/// In about the time of a pass over L, without the memory of that.
std::int64_t factor_size(std::int64_t size, const std::vector<SparseEntry>& entries);

/// A row for each point.
using PointRows = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// The x, of so many rows, for which the sum of weight |A x + known|^2 over the rows of A is least, by its normal
/// equations; without rows if these cannot be factorised. `weight` and `known` are of each row of A. Deterministic.
PointRows least_squares(std::int64_t unknown, const std::vector<SparseEntry>& entries, const Eigen::VectorXd& weight,
                        const PointRows& known);

}  // namespace kerf
