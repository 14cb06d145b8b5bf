#include "base/geometry/sparse_factors.h"

#include <numeric>

#include <Eigen/SparseCholesky>

namespace kerf {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

SparseMatrix matrix_of(std::int64_t rows, std::int64_t columns, const std::vector<SparseEntry>& entries) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    for (const SparseEntry& e : entries) triplets.emplace_back(e.row, e.column, e.value);
    SparseMatrix matrix(rows, columns);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
}

}  // namespace

struct SparseFactors::Factors {
    Eigen::SimplicialLDLT<SparseMatrix> of_matrix;
};

SparseFactors::SparseFactors() = default;
SparseFactors::SparseFactors(SparseFactors&&) noexcept = default;
SparseFactors& SparseFactors::operator=(SparseFactors&&) noexcept = default;
SparseFactors::~SparseFactors() = default;

SparseFactors::SparseFactors(std::int64_t size, const std::vector<SparseEntry>& entries,
                             const CancellationCheck& check_cancelled)
    : factors_(std::make_unique<Factors>()) {
    const SparseMatrix matrix = matrix_of(size, size, entries);
    check_cancelled();
    factors_->of_matrix.analyzePattern(matrix);
    check_cancelled();
    factors_->of_matrix.factorize(matrix);
    check_cancelled();
}

bool SparseFactors::are_positive() const {
    if (!factors_) return true;
    return factors_->of_matrix.info() == Eigen::Success && (factors_->of_matrix.vectorD().array() > 0).all();
}

Eigen::VectorXd SparseFactors::solve(const Eigen::VectorXd& right) const { return factors_->of_matrix.solve(right); }

std::int64_t factor_size(std::int64_t size, const std::vector<SparseEntry>& entries) {
    struct Analysis : Eigen::SimplicialLDLT<SparseMatrix> {
        explicit Analysis(const SparseMatrix& matrix) { analyzePattern(matrix); }
        std::int64_t below_diagonal() const {
            return std::accumulate(m_nonZerosPerCol.data(), m_nonZerosPerCol.data() + m_nonZerosPerCol.size(),
                                   std::int64_t{0});
        }
    };
    return size + Analysis(matrix_of(size, size, entries)).below_diagonal();
}

PointRows least_squares(std::int64_t unknown, const std::vector<SparseEntry>& entries, const Eigen::VectorXd& weight,
                        const PointRows& known) {
    const SparseMatrix matrix = matrix_of(weight.size(), unknown, entries);
    const SparseMatrix weighted = weight.asDiagonal() * matrix;
    const SparseMatrix normal = SparseMatrix(matrix.transpose()) * weighted;
    const Eigen::SimplicialLDLT<SparseMatrix> factors(normal);
    if (factors.info() != Eigen::Success) return {};
    return factors.solve(-(weighted.transpose() * known));
}

}  // namespace kerf
