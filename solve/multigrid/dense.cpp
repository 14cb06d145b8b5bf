#include "solve/multigrid/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace kerf {

template <int B>
void invert(Eigen::Map<RowMajorBlock<B, B>> block) {
    using Block = RowMajorBlock<B, B>;
    block = Block(block).ldlt().solve(Block::Identity()).eval();
}
template void invert<3>(Eigen::Map<RowMajorBlock<3, 3>>);
template void invert<6>(Eigen::Map<RowMajorBlock<6, 6>>);

double largest_tridiagonal_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
    const Eigen::Index size = diagonal.size();
    Eigen::MatrixXd tridiagonal = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index k = 0; k < size; ++k) tridiagonal(k, k) = diagonal[k];
    for (Eigen::Index k = 0; k + 1 < size; ++k) tridiagonal(k, k + 1) = tridiagonal(k + 1, k) = beside[k];
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tridiagonal, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
    if (matrix.size() == 0) return {};
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

SixAxes symmetric_axes(const Eigen::Matrix<double, 6, 6>& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd right_singular_vectors(const Eigen::MatrixXd& matrix) {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix, Eigen::ComputeFullV).matrixV();
}

Eigen::MatrixXd orthogonal_from(const Eigen::MatrixXd& vector) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(vector);
    return qr.householderQ();
}

struct DenseFactors::Factors {
    Eigen::LDLT<Eigen::MatrixXd> of_matrix;
};

DenseFactors::DenseFactors(const Eigen::MatrixXd& matrix)
    : factors_(new Factors{Eigen::LDLT<Eigen::MatrixXd>(matrix)}) {}
DenseFactors::~DenseFactors() = default;

double DenseFactors::least_pivot() const { return factors_->of_matrix.vectorD().minCoeff(); }

Eigen::VectorXd DenseFactors::solve(const Eigen::VectorXd& right) const { return factors_->of_matrix.solve(right); }

DenseFactors::SixColumns DenseFactors::solve(const SixColumns& right) const { return factors_->of_matrix.solve(right); }

}  // namespace kerf
