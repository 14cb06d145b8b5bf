// Modes solve K x = w^2 M x with the stiffness K and the consistent mass M. Supports may leave the body free, so that K
// is singular; the lowest eigenpairs of K + s M and M are found instead (solve/multigrid/block_eigensolver.h), with
// eigenvalues w^2 + s, and the multigrid is made for K + s M. The shift s is a little of the square of the lowest
// frequency of a beam with the same extents, since one far above it would hide the differences between the lowest
// modes. A mode with w^2 below 1e-6 s, or below the rounding of K, is a rigid motion of frequency 0. The block has four
// vectors more than are asked for, since its last ones converge slowly.
#include "solve/equations/modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/mixed_bits.h"
#include "base/geometry/symmetric_axes.h"
#include "solve/equations/inside/block_rows.h"
#include "solve/equations/inside/held_stiffness.h"
#include "solve/equations/inside/mass_matrix.h"
#include "solve/multigrid/block_eigensolver.h"

namespace kerf {

namespace {

constexpr int guard_modes = 4;  // the last of a block are slow, so there are more than asked for

// Returns a little of the square of the lowest frequency of a straight beam with the extents of the body: that falls
// with h^2 / L^4, and a shift far above it hides the differences between the lowest. The radii of gyration are of the
// nodes.
double small_frequency_squared(const ElasticProblem& problem) {
    const MpiRanks& ranks = problem.space->ranks();
    const std::size_t owned = problem.space->owned_count();
    const auto points = std::span(problem.space->points()).first(owned);
    std::array<double, 4> sums{0, 0, 0, static_cast<double>(owned)};
    for (const Vec3& point : points)
        for (int c = 0; c < 3; ++c) sums[c] += point[c];
    ranks.all_reduce(std::span<double>(sums), Reduction::sum);
    const Vec3 middle = Vec3(sums[0], sums[1], sums[2]) / sums[3];
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& point : points) spread += (point - middle) * (point - middle).transpose();
    ranks.all_reduce(std::span(spread.data(), 9), Reduction::sum);
    const Vec3 squares = symmetric_axes(Eigen::Matrix3d(spread / sums[3])).values;
    const double longest = squares[2], shortest = std::max(squares[0], 1e-8 * longest);
    double slowest = HUGE_VAL;
    for (const Material& material : problem.materials) slowest = std::min(slowest, material.young / material.density);
    return 0.1 * slowest * shortest / longest / (12 * longest);
}

// The work of find_modes(): finds the lowest eigenvalues of K + s M and M.
class ModeSolver {
 public:
    // Assembles the equations and their multigrid for `count` modes. Collective.
    ModeSolver(const ElasticProblem& problem, int count);

    // Finds the modes. Collective. Throws as find_modes() does.
    FoundModes find(const AfterModesIteration& after_iteration);

 private:
    EigenProblem equations();
    Eigen::MatrixXd start(int columns) const;
    Mode make_mode(const Eigen::VectorXd& shape, double eigenvalue, double residual);
    template <class Work>
    void apply(const Eigen::VectorXd& from, Eigen::Ref<Eigen::VectorXd> to, Work work);

    const ElasticProblem& problem_;
    int count_;
    double mass_factor_;  // s
    HeldStiffness stiffness_;
    MassMatrix mass_;
    std::unique_ptr<MultigridLevel> multigrid_;
    std::vector<double> given_, found_;  // with room for ghosts
};

template <class Work>
void ModeSolver::apply(const Eigen::VectorXd& from, Eigen::Ref<Eigen::VectorXd> to, Work work) {
    const LevelMatrix<3>& matrix = stiffness_.matrix;
    given_.resize(matrix.size());
    found_.resize(matrix.size());
    std::copy_n(from.data(), matrix.owned_size(), given_.begin());
    work();
    for (std::size_t dof = 0; dof < matrix.owned_size(); ++dof) to[dof] = problem_.is_held(dof) ? 0 : found_[dof];
}

EigenProblem ModeSolver::equations() {
    EigenProblem equations;
    equations.multiply_a = [this](const Eigen::VectorXd& from, Eigen::Ref<Eigen::VectorXd> to) {
        apply(from, to, [&] { stiffness_.matrix.multiply(given_, found_); });
    };
    equations.multiply_b = [this](const Eigen::VectorXd& from, Eigen::Ref<Eigen::VectorXd> to) {
        apply(from, to, [&] { mass_.multiply(given_, found_); });
    };
    equations.precondition = [this](const Eigen::VectorXd& from, Eigen::Ref<Eigen::VectorXd> to) {
        apply(from, to, [&] { multigrid_->cycle(given_, found_); });
    };
    return equations;
}

// Returns fixed numbers that look like random ones, zero where a degree of freedom is held.
Eigen::MatrixXd ModeSolver::start(int columns) const {
    Eigen::MatrixXd vectors(stiffness_.matrix.owned_size(), columns);
    RandomSequence random(0x9e3779b97f4a7c15 + problem_.space->first_row());
    for (auto column : vectors.colwise())
        for (Eigen::Index dof = 0; dof < vectors.rows(); ++dof) {
            const double number = random.next_centred();  // drawn for held ones, too
            column[dof] = problem_.is_held(dof) ? 0 : number;
        }
    return vectors;
}

ModeSolver::ModeSolver(const ElasticProblem& problem, int count)
    : problem_(problem),
      count_(count),
      mass_factor_(small_frequency_squared(problem)),
      stiffness_(hold_stiffness(problem, stiffness_of_rank(problem, {{}, mass_factor_}))),
      mass_(problem, stiffness_.matrix.share),
      multigrid_(multigrid_for(problem, stiffness_, mass_factor_)) {}

Mode ModeSolver::make_mode(const Eigen::VectorXd& shape, double eigenvalue, double residual) {
    const LevelMatrix<3>& matrix = stiffness_.matrix;
    Mode mode;
    const double value = eigenvalue - mass_factor_;
    const double rounding = 0x1p-53 * stiffness_.norm / mass_.mean_diagonal();
    mode.is_rigid = value < std::max(1e-6 * mass_factor_, rounding);
    mode.frequency = mode.is_rigid ? 0 : std::sqrt(value) / (2 * std::numbers::pi);
    mode.residual = residual;
    mode.shape.assign(matrix.size(), 0);
    std::copy_n(shape.data(), matrix.owned_size(), mode.shape.begin());
    std::vector<double> of_mass;
    mass_.multiply(mode.shape, of_mass);
    const MpiRanks& ranks = problem_.space->ranks();
    double largest = 0, smallest = 0;
    for (std::int32_t n = 0; n < matrix.owned; ++n) {
        const Vec3 moved = problem_.frames.from_frame(n, Eigen::Map<const Vec3>(&mode.shape[3 * n]));
        largest = std::max(largest, moved.maxCoeff());
        smallest = std::min(smallest, moved.minCoeff());
    }
    largest = ranks.all_reduce(largest, Reduction::largest);
    smallest = ranks.all_reduce(smallest, Reduction::smallest);
    const double sign = largest >= -smallest ? 1 : -1;
    const double scale = sign / std::sqrt(dot_of_owned(ranks, matrix.owned_size(), mode.shape, of_mass));
    for (double& component : mode.shape) component *= scale;
    problem_.frames.from_frames(mode.shape);
    mode.displacement = largest_displacement(*problem_.space, mode.shape);
    return mode;
}

FoundModes ModeSolver::find(const AfterModesIteration& after_iteration) {
    EigenGoal goal;
    goal.count = count_;
    const EigenPairs pairs =
        smallest_eigenpairs(problem_.space->ranks(), equations(), goal, start(count_ + guard_modes), after_iteration);
    if (pairs.converged < count_)
        throw Error(ErrorCode::convergence,
                    fmt::format("{} of {} modes were found in {} iterations. Ask for fewer, or use a mesh with better "
                                "cells (kerf quality).",
                                pairs.converged, count_, pairs.iterations));
    FoundModes found;
    found.iterations = pairs.iterations;
    for (int m = 0; m < count_; ++m)
        found.modes.push_back(make_mode(pairs.vectors.col(m), pairs.values[m], pairs.residuals[m]));
    return found;
}

void require_density(const ElasticProblem& problem) {
    for (const Material& material : problem.materials)
        if (!(material.density > 0))
            throw Error(ErrorCode::usage, fmt::format("Modes need the density of material '{}'. Add density to it, in "
                                                      "t/mm^3 with mm and MPa, or in kg/m^3 with m and Pa.",
                                                      material.name));
}

}  // namespace

FoundModes find_modes(const ElasticProblem& problem, int count, const AfterModesIteration& after_iteration) {
    require_density(problem);
    std::int64_t free = 0;
    for (std::int32_t dof = 0; dof < 3 * problem.space->owned_count(); ++dof) free += problem.is_held(dof) ? 0 : 1;
    free = problem.space->ranks().all_reduce(free, Reduction::sum);
    if (4 * static_cast<std::int64_t>(count) > free)
        throw Error(ErrorCode::usage, fmt::format("{} modes are too many for {} free degrees of freedom. Ask for {} at "
                                                  "most, or use a finer mesh.",
                                                  count, free, free / 4));
    return ModeSolver(problem, count).find(after_iteration);
}

std::string to_text(const std::vector<Mode>& modes) {
    std::string text;
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const Mode& mode = modes[m];
        text += fmt::format("{:<12}{:>3}  {}\n", "mode", m + 1,
                            mode.is_rigid ? std::string("rigid motion") : fmt::format("{:.6g} Hz", mode.frequency));
    }
    return text;
}

std::string to_csv(const std::vector<Mode>& modes) {
    std::string text = "mode,frequency_hz,rigid,residual\n";
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const Mode& mode = modes[m];
        text += fmt::format("{},{:.12g},{},{:.3g}\n", m + 1, mode.frequency, mode.is_rigid ? 1 : 0, mode.residual);
    }
    return text;
}

}  // namespace kerf
