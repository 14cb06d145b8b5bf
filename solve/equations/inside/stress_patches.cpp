// Superconvergent patch recovery (Zienkiewicz and Zhu 1992, zienkiewicz1992). The patch of a vertex are the cells
// around it of one material; the stresses at four points of each are fitted by a polynomial of degree 2 in the distance
// from the vertex, weighted by volumes. Its normal equations are 55 products of 10 monomials and 10 x 6 right sides,
// which ranks add up; they are scaled to ones on the diagonal and solved by the owner. A patch at a corner or an edge
// of the body has too few cells: if a pivot is tiny, or an error of all stresses would grow too much on its way to the
// vertex, the degree is lowered. A vertex takes the value of its own polynomial, a node on an edge the mean of those of
// both ends.
#include "solve/equations/inside/stress_patches.h"

#include <algorithm>

#include <Eigen/Core>

#include "solve/equations/inside/element_stress.h"
#include "solve/multigrid/dense.h"

namespace kerf {

namespace {

constexpr int monomials = 10, tensor_size = 6;
constexpr int products = monomials * (monomials + 1) / 2;  // of two monomials
constexpr std::array<int, 3> terms_of_degree = {1, 4, 10};

using Monomials = Eigen::Matrix<double, monomials, 1>;
using Coefficients = Eigen::Matrix<double, monomials, tensor_size>;

// Returns the monomials of the distance from the vertex.
Monomials monomials_at(const Vec3& d) {
    Monomials m;
    m << 1, d.x(), d.y(), d.z(), d.x() * d.x(), d.y() * d.y(), d.z() * d.z(), d.x() * d.y(), d.y() * d.z(),
        d.x() * d.z();
    return m;
}

constexpr double least_pivot = 1e-9;   // of scaled equations that are worth solving
constexpr double largest_growth = 30;  // of the square of an error of all stresses, on its way to the vertex

class PatchFit {
 public:
    PatchFit(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number,
             const MaterialNodes& numbers)
        : problem_(problem), space_(*problem.space), displacement_(displacement), number_(number), numbers_(numbers) {
        number_vertices();
    }
    std::vector<SymmetricTensor> at_nodes();

 private:
    void number_vertices();
    void add_equations();
    void solve(std::size_t vertex);
    Eigen::Map<Coefficients> polynomial(std::int32_t vertex) {
        return Eigen::Map<Coefficients>(&values_[static_cast<std::size_t>(vertex) * monomials * tensor_size]);
    }
    SymmetricTensor value_at(std::int32_t vertex, const Vec3& distance) {
        return polynomial(vertex).transpose() * monomials_at(distance);
    }

    const ElasticProblem& problem_;
    const FeSpace& space_;
    const std::vector<double>& displacement_;
    std::size_t number_;
    const MaterialNodes& numbers_;
    std::vector<std::int32_t> vertex_of_;   // of each of these numbers; -1: on an edge
    std::size_t owned_ = 0, vertices_ = 0;  // vertices of this rank, and with ghosts
    Ownership ownership_;
    std::vector<double> products_, values_;
};

// Numbers the vertices; ghosts come after the own ones, as among nodes.
void PatchFit::number_vertices() {
    vertex_of_.assign(numbers_.count(), -1);
    for (const PartFeNodes& part : space_.nodes_of_parts())
        for (const std::int32_t node : part.of_vertex)
            for (std::int32_t n = numbers_.first_of(node); n < numbers_.first_of(node + 1); ++n) vertex_of_[n] = 0;
    const std::int32_t first_ghost = numbers_.first_of(space_.owned_count());
    for (std::int32_t n = 0; n < numbers_.count(); ++n) {
        if (vertex_of_[n] < 0) continue;
        vertex_of_[n] = vertices_++;
        if (n < first_ghost) owned_ = vertices_;
    }
    ownership_ = numbers_.ownership().renumbered(vertex_of_);
}

void PatchFit::add_equations() {
    products_.assign(products * vertices_, 0);
    values_.assign(monomials * tensor_size * vertices_, 0);
    for_all_tets(space_, [&](std::size_t p, std::size_t t) {
        const ElementStress element(problem_, displacement_, number_, p, t);
        const auto nodes = space_.nodes_of(p, t), numbers = numbers_.of(p, t);
        for (const TetPoint& at : quadrature::four_points) {
            const double weight = at.weight * element.element().volume();
            const SymmetricTensor stress = weight * element.stress(at.place);
            const Vec3 place = element.element().position_of(at.place);
            for (std::size_t i = 0; i < 4; ++i) {
                const Monomials m = monomials_at(place - space_.points()[nodes[i]]);
                const std::int32_t vertex = vertex_of_[numbers[i]];
                polynomial(vertex).noalias() += m * stress.transpose();
                double* sum = &products_[static_cast<std::size_t>(vertex) * products];
                for (int a = 0; a < monomials; ++a)
                    for (int b = 0; b <= a; ++b) *sum++ += weight * m[a] * m[b];
            }
        }
    });
    ownership_.sum_to_owners(std::span(products_), products);
    ownership_.sum_to_owners(std::span(values_), monomials * tensor_size);
}

void PatchFit::solve(std::size_t vertex) {
    Eigen::Matrix<double, monomials, monomials> matrix;
    const double* sum = &products_[vertex * products];
    for (int a = 0; a < monomials; ++a)
        for (int b = 0; b <= a; ++b) matrix(a, b) = matrix(b, a) = *sum++;
    if (!(matrix(0, 0) > 0)) return;  // the volume
    const Monomials scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
    auto found = polynomial(vertex);
    const Coefficients right = scale.asDiagonal() * found;
    found.setZero();
    for (int degree = 2; degree >= 0; --degree) {
        const int terms = terms_of_degree[degree];
        const DenseFactors factors(matrix.topLeftCorner(terms, terms));
        if (degree > 0 && factors.least_pivot() <= least_pivot) continue;
        // With stresses as they are in one cell, degree 1 is always determined, and exact.
        if (degree == 2 && !(factors.solve(Eigen::VectorXd(Eigen::VectorXd::Unit(terms, 0)))[0] <= largest_growth))
            continue;
        found.topRows(terms) =
            scale.head(terms).asDiagonal() * factors.solve(DenseFactors::SixColumns(right.topRows(terms)));
        return;
    }
}

std::vector<SymmetricTensor> PatchFit::at_nodes() {
    add_equations();
    for (std::size_t v = 0; v < owned_; ++v) solve(v);
    products_ = {};
    ownership_.from_owners(std::span(values_), monomials * tensor_size);
    std::vector<SymmetricTensor> stresses(numbers_.count(), SymmetricTensor::Zero());
    for_all_tets(space_, [&](std::size_t p, std::size_t t) {
        const auto nodes = space_.nodes_of(p, t), numbers = numbers_.of(p, t);
        for (std::size_t i = 0; i < 4; ++i)
            stresses[numbers[i]] = polynomial(vertex_of_[numbers[i]]).row(0).transpose();
        for (std::size_t e = 0; e < 6; ++e) {
            const auto value_from = [&](int end) {
                const Vec3& place = space_.points()[nodes[4 + e]];
                return value_at(vertex_of_[numbers[end]], place - space_.points()[nodes[end]]);
            };
            stresses[numbers[4 + e]] = 0.5 * (value_from(tet_edges[e][0]) + value_from(tet_edges[e][1]));
        }
    });
    return stresses;
}

}  // namespace

std::vector<SymmetricTensor> fit_stresses(const ElasticProblem& problem, const std::vector<double>& displacement,
                                          std::size_t number, const MaterialNodes& numbers) {
    return PatchFit(problem, displacement, number, numbers).at_nodes();
}

}  // namespace kerf
