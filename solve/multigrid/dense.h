// Factorisations of small matrices, which take long to compile.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "solve/multigrid/symmetric_blocks.h"

namespace kerf {

/// Replaces a symmetric block by its inverse; B is 3 or 6.
template <int B>
void invert(Eigen::Map<RowMajorBlock<B, B>> block);

/// Returns the largest eigenvalue of the symmetric tridiagonal matrix with these numbers on its diagonal, of which
/// there is one at least, and beside it.
double largest_tridiagonal_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside);

/// Eigenvalues, ascending, and unit eigenvectors, a column each, of a symmetric matrix of any size, which may be 0.
struct SymmetricEigen {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// Eigenvalues, ascending, and unit eigenvectors, a column each, of a symmetric matrix of six rows.
struct SixAxes {
    Eigen::Matrix<double, 6, 1> values;
    Eigen::Matrix<double, 6, 6> vectors;
};
SixAxes symmetric_axes(const Eigen::Matrix<double, 6, 6>& matrix);

/// Returns V of the singular value decomposition: the square orthogonal matrix whose columns the matrix maps to ever
/// shorter vectors.
Eigen::MatrixXd right_singular_vectors(const Eigen::MatrixXd& matrix);

/// Returns a square orthogonal matrix whose first column is along the vector, which is given as a matrix of one column.
Eigen::MatrixXd orthogonal_from(const Eigen::MatrixXd& vector);

/// The factors L D L^T of a symmetric matrix, with pivots.
class DenseFactors {
 public:
    explicit DenseFactors(const Eigen::MatrixXd& matrix);
    DenseFactors(const DenseFactors&) = delete;
    DenseFactors& operator=(const DenseFactors&) = delete;
    ~DenseFactors();

    /// Returns the smallest number of the diagonal matrix D.
    double least_pivot() const;
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
    using SixColumns = Eigen::Matrix<double, Eigen::Dynamic, 6>;
    SixColumns solve(const SixColumns& right) const;

 private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

}  // namespace kerf
