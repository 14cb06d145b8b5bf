// Smoothing by Chebyshev's polynomials, preconditioned by the blocks of the diagonal.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "base/core/mixed_bits.h"
#include "solve/multigrid/dense.h"
#include "solve/multigrid/level_matrix.h"

namespace kerf {

/// A fixed polynomial of D^-1 A that is small on the upper part of the spectrum, D being the blocks of the diagonal
/// (Adams, Brezina, Hu and Tuminaro 2003, adams2003). The same smoothing before and after a coarse correction leaves
/// the cycle symmetric.
template <int B>
class ChebyshevSmoother {
 public:
    /// Estimates the largest eigenvalue of D^-1 A by a few steps of Lanczos's method from a fixed start. Collective.
    explicit ChebyshevSmoother(const LevelMatrix<B>& matrix)
        : matrix_(&matrix), inverse_(matrix.inverse_diagonal()), largest_(lanczos_estimate()) {}

    double largest_eigenvalue() const { return largest_; }
    /// Returns the inverse of the diagonal block of an owned node.
    Eigen::Map<const RowMajorBlock<B, B>> inverse(std::int32_t node) const {
        return Eigen::Map<const RowMajorBlock<B, B>>(&inverse_[B * B * node]);
    }

    /// Improves x, which is zero before the call if `from_zero`. Collective.
    void smooth(const std::vector<double>& right, std::vector<double>& x, bool from_zero) {
        const double upper = 1.1 * largest_, lower = 0.1 * largest_;
        const double center = (upper + lower) / 2, half = (upper - lower) / 2, sigma = center / half;
        const std::size_t size = matrix_->owned_size();
        double rho = 1 / sigma;
        step_.assign(matrix_->size(), 0);
        for (int k = 0; k < degree; ++k) {
            if (k == 0 && from_zero)
                product_.assign(matrix_->size(), 0);
            else
                matrix_->multiply(x, product_);
            const double next = 1 / (2 * sigma - rho);
            const double keep = k == 0 ? 0 : rho * next, take = k == 0 ? 1 / center : 2 * next / half;
            for (std::size_t i = 0; i < size; ++i) product_[i] = right[i] - product_[i];
            for (std::int32_t n = 0; n < matrix_->owned; ++n) {
                Eigen::Map<Vector> step(&step_[B * n]);
                step = keep * step + take * (inverse(n) * Eigen::Map<const Vector>(&product_[B * n]));
                Eigen::Map<Vector>(&x[B * n]) += step;
            }
            if (k > 0) rho = next;
        }
    }

 private:
    using Vector = Eigen::Matrix<double, B, 1>;
    static constexpr int degree = 2, lanczos_steps = 10;

    // Conjugate gradients yield the entries of Lanczos's tridiagonal matrix.
    double lanczos_estimate() const {
        const MpiRanks& ranks = matrix_->ownership.ranks();
        const std::size_t size = matrix_->owned_size();
        std::vector<double> r(matrix_->size(), 0), z = r, p = r, q = r;
        RandomSequence random(0x9e3779b97f4a7c15);
        for (std::size_t i = 0; i < size; ++i) r[i] = random.next_centred();
        std::vector<double> diagonal, beside;
        double rho = 0, alpha = 1;
        for (int k = 0; k < lanczos_steps; ++k) {
            for (std::int32_t n = 0; n < matrix_->owned; ++n)
                Eigen::Map<Vector>{&z[B * n]} = inverse(n) * Eigen::Map<const Vector>(&r[B * n]);
            const double rho_before = rho;
            rho = dot_of_owned(ranks, size, r, z);
            if (!(rho > 0)) break;
            const double beta = k == 0 ? 0 : rho / rho_before;
            for (std::size_t i = 0; i < size; ++i) p[i] = z[i] + beta * p[i];
            matrix_->multiply(p, q);
            const double curvature = dot_of_owned(ranks, size, p, q);
            if (!(curvature > 0)) break;
            diagonal.push_back(curvature / rho + (k == 0 ? 0 : beta / alpha));
            if (k > 0) beside.push_back(std::sqrt(beta) / alpha);
            alpha = rho / curvature;
            for (std::size_t i = 0; i < size; ++i) r[i] -= alpha * q[i];
        }
        return diagonal.empty() ? 1 : largest_tridiagonal_eigenvalue(diagonal, beside);
    }

    const LevelMatrix<B>* matrix_;
    std::vector<double> inverse_;
    std::vector<double> step_, product_;  // work space of smooth()
    double largest_;
};

}  // namespace kerf
