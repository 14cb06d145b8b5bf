// The only source that knows SLEPc.
#include "solve/mode_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <slepceps.h>

#include "core/error.h"
#include "solve/block_rows.h"
#include "solve/petsc_session.h"

namespace kerf {

namespace {

constexpr double mode_tolerance = 1e-6;  // of the residual: frequencies have about its square
constexpr int most_mode_iterations = 1000;
constexpr int guard_modes = 4;  // the last of a block are slow, so there are more than asked for

// A little of the square of the lowest frequency of a body that is as long as wide: (c / L)^2, with the speed of sound.
double small_frequency_squared(const ElasticProblem& problem) {
    std::array<double, 3> low, high;
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    for (const Vec3& point : problem.space->points())
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], point[c]);
            high[c] = std::max(high[c], point[c]);
        }
    const MpiRanks& ranks = problem.space->ranks();
    ranks.all_reduce(std::span<double>(low), Reduction::smallest);
    ranks.all_reduce(std::span<double>(high), Reduction::largest);
    double diagonal = 0, slowest = HUGE_VAL;
    for (int c = 0; c < 3; ++c) diagonal += (high[c] - low[c]) * (high[c] - low[c]);
    for (const Material& material : problem.materials) slowest = std::min(slowest, material.young / material.density);
    return 0.1 * slowest / diagonal;
}

}  // namespace

// What SLEPc calls, on copies of its vectors. What that throws must not cross it.
struct ModeSolver::Calls {
    explicit Calls(ModeSolver& owner) : solver(owner) {}
    ~Calls() {
        EPSDestroy(&eps);
        MatDestroy(&stiffness);
        MatDestroy(&mass);
        if (is_own) SlepcFinalize();
    }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    void prepare();
    void choose_start(int block) const;
    void check_call(int code) const {
        if (failure) std::rethrow_exception(failure);
        check(code);
    }
    template <class Work>
    PetscErrorCode apply(Vec from, Vec to, double factor, Work work);
    static PetscErrorCode multiply_stiffness(Mat matrix, Vec x, Vec y);
    static PetscErrorCode multiply_mass(Mat matrix, Vec x, Vec y);
    static PetscErrorCode precondition(PC preconditioner, Vec right, Vec x);
    static PetscErrorCode tell_iteration(EPS eps, PetscInt iteration, PetscInt found, PetscScalar* real,
                                         PetscScalar* imaginary, PetscReal* errors, PetscInt count, void* self);

    ModeSolver& solver;
    bool is_own = false;
    EPS eps = nullptr;
    Mat stiffness = nullptr, mass = nullptr;
    std::vector<double> given, found;
    std::exception_ptr failure;
};

template <class Work>
PetscErrorCode ModeSolver::Calls::apply(Vec from, Vec to, double factor, Work work) {
    const LevelMatrix<3>& matrix = solver.stiffness_.matrix;
    const double* values = nullptr;
    double* result = nullptr;
    given.resize(matrix.size());
    found.resize(matrix.size());
    PetscCall(VecGetArrayRead(from, &values));
    std::copy_n(values, matrix.owned_size(), given.begin());
    PetscCall(VecRestoreArrayRead(from, &values));
    try {
        work();
    } catch (...) {
        failure = std::current_exception();
        return PETSC_ERR_LIB;
    }
    PetscCall(VecGetArrayWrite(to, &result));
    for (std::size_t dof = 0; dof < matrix.owned_size(); ++dof)
        result[dof] = solver.problem_.is_held(dof) ? 0 : factor * found[dof];
    PetscCall(VecRestoreArrayWrite(to, &result));
    return 0;
}

PetscErrorCode ModeSolver::Calls::multiply_stiffness(Mat matrix, Vec x, Vec y) {
    Calls* self = nullptr;
    PetscCall(MatShellGetContext(matrix, &self));
    return self->apply(x, y, 1 / self->solver.stiffness_scale_,
                       [&] { self->solver.stiffness_.matrix.multiply(self->given, self->found); });
}

PetscErrorCode ModeSolver::Calls::multiply_mass(Mat matrix, Vec x, Vec y) {
    Calls* self = nullptr;
    PetscCall(MatShellGetContext(matrix, &self));
    return self->apply(x, y, 1 / self->solver.mass_scale_,
                       [&] { self->solver.mass_.multiply(self->given, self->found); });
}

PetscErrorCode ModeSolver::Calls::precondition(PC preconditioner, Vec right, Vec x) {
    Calls* self = nullptr;
    PetscCall(PCShellGetContext(preconditioner, &self));
    return self->apply(right, x, self->solver.stiffness_scale_,
                       [&] { self->solver.multigrid_->cycle(self->given, self->found); });
}

PetscErrorCode ModeSolver::Calls::tell_iteration(EPS, PetscInt iteration, PetscInt found, PetscScalar*, PetscScalar*,
                                                 PetscReal*, PetscInt, void* self) {
    const AfterModesIteration& after = static_cast<Calls*>(self)->solver.after_iteration_;
    if (after) after(static_cast<int>(iteration), static_cast<int>(found));
    return 0;
}

void ModeSolver::Calls::prepare() {
    PetscBool is_running = PETSC_FALSE;
    check(SlepcInitialized(&is_running));
    is_own = !is_running;
    if (is_own) check(SlepcInitializeNoArguments());
    MPI_Comm ranks = solver.problem_.space->ranks().handle();
    const auto own = static_cast<PetscInt>(solver.stiffness_.matrix.owned_size());
    const auto make = [&](Mat* matrix, PetscErrorCode (*multiply)(Mat, Vec, Vec)) {
        check(MatCreateShell(ranks, own, own, PETSC_DETERMINE, PETSC_DETERMINE, this, matrix));
        check(MatShellSetOperation(*matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
        check(MatSetOption(*matrix, MAT_SYMMETRIC, PETSC_TRUE));
    };
    make(&stiffness, multiply_stiffness);
    make(&mass, multiply_mass);
    check(EPSCreate(ranks, &eps));
    check(EPSSetOperators(eps, stiffness, mass));
    check(EPSSetProblemType(eps, EPS_GHEP));
    check(EPSSetType(eps, EPSLOBPCG));
    check(EPSSetWhichEigenpairs(eps, EPS_SMALLEST_REAL));
    const int block = solver.count_ + guard_modes;
    check(EPSSetDimensions(eps, solver.count_, PETSC_DEFAULT, PETSC_DEFAULT));
    check(EPSLOBPCGSetBlockSize(eps, block));
    check(EPSSetTolerances(eps, mode_tolerance, most_mode_iterations));
    check(EPSSetConvergenceTest(eps, EPS_CONV_REL));
    check(EPSMonitorSet(eps, tell_iteration, this, nullptr));
    ST transformation = nullptr;
    KSP inner = nullptr;
    PC preconditioner = nullptr;
    check(EPSGetST(eps, &transformation));
    check(STSetType(transformation, STPRECOND));
    check(STGetKSP(transformation, &inner));
    check(KSPSetType(inner, KSPPREONLY));
    check(KSPGetPC(inner, &preconditioner));
    check(PCSetType(preconditioner, PCSHELL));
    check(PCShellSetContext(preconditioner, this));
    check(PCShellSetApply(preconditioner, precondition));
    check(EPSSetFromOptions(eps));
    choose_start(block);
}

// Fixed numbers that look like random ones, nothing where it is held.
void ModeSolver::Calls::choose_start(int block) const {
    std::vector<Vec> start(block, nullptr);
    std::uint64_t state = 0x9e3779b97f4a7c15 + static_cast<std::uint64_t>(solver.problem_.space->first_row());
    for (Vec& vector : start) {
        check(MatCreateVecs(stiffness, &vector, nullptr));
        double* values = nullptr;
        check(VecGetArrayWrite(vector, &values));
        for (std::size_t dof = 0; dof < solver.stiffness_.matrix.owned_size(); ++dof) {
            state = state * 6364136223846793005 + 1442695040888963407;
            values[dof] = solver.problem_.is_held(dof) ? 0 : static_cast<double>(state >> 40) * 0x1p-24 - 0.5;
        }
        check(VecRestoreArrayWrite(vector, &values));
    }
    check(EPSSetInitialSpace(eps, block, start.data()));
    for (Vec& vector : start) check(VecDestroy(&vector));
}

ModeSolver::ModeSolver(const ElasticProblem& problem, int count, const AfterModesIteration& after_iteration)
    : problem_(problem),
      count_(count),
      after_iteration_(after_iteration),
      mass_factor_(small_frequency_squared(problem)),
      stiffness_(hold_stiffness(problem, stiffness_of_rank(problem, {{}, mass_factor_}))),
      mass_(problem, stiffness_.matrix.share),
      multigrid_(multigrid_for(problem, stiffness_, mass_factor_)),
      stiffness_scale_(stiffness_.diagonal),
      mass_scale_(mass_.mean_diagonal()),
      calls_(std::make_unique<Calls>(*this)) {
    calls_->prepare();
}

ModeSolver::~ModeSolver() = default;

double ModeSolver::eigenvalue(int number) {
    double value = 0;
    check(EPSGetEigenvalue(calls_->eps, number, &value, nullptr));
    return value * stiffness_scale_ / mass_scale_ - mass_factor_;
}

Mode ModeSolver::mode_at(int number, double lowest_elastic) {
    const LevelMatrix<3>& matrix = stiffness_.matrix;
    Mode mode;
    const double value = eigenvalue(number);
    mode.is_rigid = value < lowest_elastic;
    mode.frequency = mode.is_rigid ? 0 : std::sqrt(value) / (2 * std::numbers::pi);
    Vec shape = nullptr;
    check(MatCreateVecs(calls_->stiffness, &shape, nullptr));
    check(EPSGetEigenvector(calls_->eps, number, shape, nullptr));
    const double* values = nullptr;
    check(VecGetArrayRead(shape, &values));
    mode.shape.assign(matrix.size(), 0);
    std::copy_n(values, matrix.owned_size(), mode.shape.begin());
    check(VecRestoreArrayRead(shape, &values));
    check(VecDestroy(&shape));
    const MpiRanks& ranks = problem_.space->ranks();
    std::vector<double> of_mass, of_stiffness;
    mass_.multiply(mode.shape, of_mass);
    const auto owned = static_cast<std::ptrdiff_t>(matrix.owned_size());
    double largest = 0, smallest = 0;
    for (std::int32_t n = 0; n < matrix.owned; ++n) {
        const Vec3 moved = problem_.frames.from_frame(n, Eigen::Map<const Vec3>(&mode.shape[3 * n]));
        largest = std::max(largest, moved.maxCoeff());
        smallest = std::min(smallest, moved.minCoeff());
    }
    largest = ranks.all_reduce(largest, Reduction::largest);
    smallest = ranks.all_reduce(smallest, Reduction::smallest);
    const double sign = largest >= -smallest ? 1 : -1;
    const double scale = sign / std::sqrt(dot_of_owned(ranks, owned, mode.shape, of_mass));
    for (double& component : mode.shape) component *= scale;
    mass_.multiply(mode.shape, of_mass);
    matrix.multiply(mode.shape, of_stiffness);
    for (std::ptrdiff_t dof = 0; dof < owned; ++dof) of_stiffness[dof] -= (value + mass_factor_) * of_mass[dof];
    mode.residual = std::sqrt(dot_of_owned(ranks, owned, of_stiffness, of_stiffness) /
                              dot_of_owned(ranks, owned, of_mass, of_mass)) /
                    (value + mass_factor_);
    problem_.frames.from_frames(mode.shape);
    mode.displacement = largest_displacement(*problem_.space, mode.shape);
    return mode;
}

FoundModes ModeSolver::find() {
    calls_->check_call(EPSSolve(calls_->eps));
    PetscInt converged = 0, iterations = 0;
    check(EPSGetConverged(calls_->eps, &converged));
    check(EPSGetIterationNumber(calls_->eps, &iterations));
    if (converged < count_)
        throw Error(ErrorCode::convergence,
                    fmt::format("{} of {} modes were found in {} iterations. Ask for fewer, or use a mesh with better "
                                "cells (kerf quality).",
                                converged, count_, iterations));
    FoundModes found;
    found.iterations = static_cast<int>(iterations);
    for (int m = 0; m < count_; ++m) found.modes.push_back(mode_at(m, 1e-6 * mass_factor_));
    return found;
}

}  // namespace kerf
