// Conjugate gradients of PETSc on a matrix that is never assembled over ranks: PETSc sees a shell whose product is that
// of LevelMatrix, and a shell preconditioner that is our multigrid. Only for "icc" the blocks among the own nodes of
// each rank become a matrix of PETSc's. Residuals are measured in the norm of the inverse of A as preconditioned
// (PETSc's natural norm), about the error in the energy norm. Conjugate gradients update their residual, and rounding
// takes it away from the true one (Greenbaum 1997, greenbaum1997): in a slender body stiffness times displacements is
// far larger than the loads. So the true residual is computed with long doubles and solved for again, as long as that
// halves it (iterative refinement: Wilkinson 1963, wilkinson1963). A residual that stays above the goal is accepted
// within LinearSystem::most_of_rounding only if the backward error says that it is rounding (Rigal and Gaches 1967,
// rigal1967). Exceptions must not cross PETSc: callbacks keep them in `failure`, and check_call() throws them.
#include "solve/equations/linear_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include <petscksp.h>

#include "base/core/stopwatch.h"
#include "solve/equations/inside/block_rows.h"
#include "solve/equations/inside/held_stiffness.h"

namespace kerf {

namespace {

constexpr double no_divergence = 1e200;  // residuals of slender bodies grow far before they fall
// A refinement goes this far below rtol, and has not helped if it leaves more of the residual than this.
constexpr double part_of_the_rest = 0.5;

// A block of the stiffness between two nodes that another rank owns.
struct SharedBlock {
    std::array<std::int32_t, 2> places{};  // of the nodes among those that both ranks have
    std::array<double, 9> block{};

    template <class Archive>
    void archive(Archive& a) {
        a(places, block);
    }
};

}  // namespace

struct LinearSystem::Impl {
    Impl(const ElasticProblem& wanted, const SolverOptions& chosen) : problem(wanted), options(chosen) {}
    ~Impl() {
        KSPDestroy(&ksp);
        VecDestroy(&right);
        VecDestroy(&solution);
        VecDestroy(&residual);
        VecDestroy(&correction);
        MatDestroy(&matrix);
        MatDestroy(&own_blocks);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void assemble();
    void create_matrix();
    void make_own_blocks();
    void prepare_solver();
    void make_multigrid();
    void check_call(int code) const;
    void set_right(const std::vector<double>& forces);
    SolveOutcome solve_refined();
    void take_residual();
    double norm(Vec values) const;
    double energy_norm(Vec values) const;
    std::size_t owned_size() const { return stiffness.matrix.owned_size(); }

    static PetscErrorCode multiply(Mat matrix, Vec x, Vec y);
    static PetscErrorCode take_diagonal(Mat matrix, Vec diagonal);
    static PetscErrorCode precondition(PC preconditioner, Vec right, Vec x);
    template <class Work>
    PetscErrorCode apply(Vec from, Vec to, Work work);
    static PetscErrorCode tell_iteration(KSP ksp, PetscInt iteration, PetscReal residual, void* self);

    const ElasticProblem& problem;
    SolverOptions options;
    HeldStiffness stiffness;
    std::unique_ptr<MultigridLevel> multigrid;
    std::vector<double> from_petsc, to_petsc;  // with room for ghosts
    std::vector<long double> exact, of_exact;  // likewise
    std::exception_ptr failure;                // of a callback
    Mat matrix = nullptr, own_blocks = nullptr;
    KSP ksp = nullptr;
    Vec right = nullptr, solution = nullptr, residual = nullptr, correction = nullptr;
    AssemblySeconds seconds;
    AfterIteration after_iteration;
    double residual_at_start = 0;
    int iterations_before = 0;  // of the solution that is refined
    std::int64_t unprepared = 0;
};

// Does work on copies of vectors. An exception of it must not cross PETSc.
template <class Work>
PetscErrorCode LinearSystem::Impl::apply(Vec from, Vec to, Work work) {
    const double* given = nullptr;
    double* found = nullptr;
    PetscCall(VecGetArrayRead(from, &given));
    from_petsc.resize(stiffness.matrix.size());
    to_petsc.resize(stiffness.matrix.size());
    std::copy_n(given, owned_size(), from_petsc.begin());
    PetscCall(VecRestoreArrayRead(from, &given));
    try {
        work();
    } catch (...) {
        failure = std::current_exception();
        return PETSC_ERR_LIB;
    }
    PetscCall(VecGetArrayWrite(to, &found));
    std::copy_n(to_petsc.begin(), owned_size(), found);
    PetscCall(VecRestoreArrayWrite(to, &found));
    return 0;
}

PetscErrorCode LinearSystem::Impl::multiply(Mat matrix, Vec x, Vec y) {
    Impl* impl = nullptr;
    PetscCall(MatShellGetContext(matrix, &impl));
    return impl->apply(x, y, [&] { impl->stiffness.matrix.multiply(impl->from_petsc, impl->to_petsc); });
}

PetscErrorCode LinearSystem::Impl::take_diagonal(Mat matrix, Vec diagonal) {
    Impl* impl = nullptr;
    PetscCall(MatShellGetContext(matrix, &impl));
    return impl->apply(diagonal, diagonal, [&] {
        const std::vector<double> blocks = impl->stiffness.matrix.diagonal();
        for (std::size_t dof = 0; dof < impl->owned_size(); ++dof) impl->to_petsc[dof] = blocks[3 * dof + dof % 3];
    });
}

PetscErrorCode LinearSystem::Impl::precondition(PC preconditioner, Vec right, Vec x) {
    Impl* impl = nullptr;
    PetscCall(PCShellGetContext(preconditioner, &impl));
    return impl->apply(right, x, [&] { impl->multigrid->cycle(impl->from_petsc, impl->to_petsc); });
}

// Called by PETSc, with the norm that ends the iterations.
PetscErrorCode LinearSystem::Impl::tell_iteration(KSP, PetscInt iteration, PetscReal residual, void* self) {
    Impl& impl = *static_cast<Impl*>(self);
    iteration += impl.iterations_before;
    if (iteration == 0) impl.residual_at_start = residual;
    if (impl.after_iteration && impl.residual_at_start > 0)
        impl.after_iteration(iteration, residual / impl.residual_at_start);
    return 0;
}

void LinearSystem::Impl::check_call(int code) const {
    if (failure) std::rethrow_exception(failure);
    check(code);
}

void LinearSystem::Impl::create_matrix() {
    const PetscInt own = owned_size();
    check(MatCreateShell(problem.space->ranks().handle(), own, own, PETSC_DETERMINE, PETSC_DETERMINE, this, &matrix));
    check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    check(MatShellSetOperation(matrix, MATOP_MULT_TRANSPOSE, reinterpret_cast<void (*)()>(multiply)));
    check(MatShellSetOperation(matrix, MATOP_GET_DIAGONAL, reinterpret_cast<void (*)()>(take_diagonal)));
    check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
}

// Makes the matrix that couples the own nodes of this rank, with the shares of other ranks: its upper half.
void LinearSystem::Impl::make_own_blocks() {
    const SymmetricBlocks<3>& share = stiffness.matrix.share;
    const Ownership& ownership = stiffness.matrix.ownership;
    std::vector<std::int32_t> place(share.row_count(), -1);
    const auto told = ownership.lists_to_owners([&](const Ownership::Neighbour& neighbour) {
        std::vector<SharedBlock> list;
        for (std::size_t i = 0; i < neighbour.items.size(); ++i) place[neighbour.items[i]] = i;
        for (const std::int32_t n : neighbour.items)
            for (std::int64_t i = share.first[n]; i < share.first[n + 1]; ++i) {
                if (place[share.columns[i]] < 0) continue;
                SharedBlock& shared = list.emplace_back();
                shared.places = {place[n], place[share.columns[i]]};
                std::copy_n(&share.values[9 * i], 9, shared.block.begin());
            }
        for (const std::int32_t n : neighbour.items) place[n] = -1;
        return list;
    });
    const std::int32_t owned = stiffness.matrix.owned;
    const PetscInt first_row = problem.space->first_row();
    const auto for_all_blocks = [&](auto visit) {
        for (std::int32_t n = 0; n < owned; ++n)
            for (std::int64_t i = share.first[n]; i < share.first[n + 1] && share.columns[i] < owned; ++i)
                visit(n, share.columns[i], share.block(i));
        for (std::size_t r = 0; r < told.size(); ++r)
            for (const SharedBlock& shared : told[r]) {
                const std::vector<std::int32_t>& nodes = ownership.owned()[r].items;
                visit(nodes[shared.places[0]], nodes[shared.places[1]],
                      Eigen::Map<const SymmetricBlocks<3>::Block>(shared.block.data()));
            }
    };
    std::vector<PetscInt> room(owned, 0);
    for_all_blocks([&](std::int32_t n, std::int32_t m, const auto&) { ++room[std::min(n, m)]; });
    for (std::int32_t n = 0; n < owned; ++n) room[n] = std::min<PetscInt>(room[n], owned - n);
    check(MatCreateSBAIJ(problem.space->ranks().handle(), 3, 3 * owned, 3 * owned, PETSC_DETERMINE, PETSC_DETERMINE, 0,
                         room.data(), 0, nullptr, &own_blocks));
    for_all_blocks([&](std::int32_t n, std::int32_t m, const auto& block) {
        SymmetricBlocks<3>::Block upper = block;
        if (n > m) upper.transposeInPlace();
        const PetscInt row = first_row + std::min(n, m), column = first_row + std::max(n, m);
        check(MatSetValuesBlocked(own_blocks, 1, &row, 1, &column, upper.data(), ADD_VALUES));
    });
    check(MatAssemblyBegin(own_blocks, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(own_blocks, MAT_FINAL_ASSEMBLY));
    check(MatSetOption(own_blocks, MAT_SPD, PETSC_TRUE));
    MatInfo info;
    check(MatGetInfo(own_blocks, MAT_GLOBAL_SUM, &info));
    unprepared = info.mallocs;
}

void LinearSystem::Impl::assemble() {
    Stopwatch stopwatch;
    SymmetricBlocks<3> share = stiffness_of_rank(problem);
    seconds.elements = stopwatch.lap();
    stiffness = hold_stiffness(problem, std::move(share));
    create_matrix();
    if (options.preconditioner == "icc") make_own_blocks();
    check(MatCreateVecs(matrix, &solution, &right));
    check(VecDuplicate(right, &residual));
    check(VecDuplicate(right, &correction));
    seconds.insert = stopwatch.lap();
}

void LinearSystem::Impl::prepare_solver() {
    PC preconditioner = nullptr;
    check(KSPCreate(problem.space->ranks().handle(), &ksp));
    check(KSPSetOperators(ksp, matrix, own_blocks ? own_blocks : matrix));
    check(KSPSetType(ksp, KSPCG));
    check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(ksp, options.rtol, 0, no_divergence, options.max_iterations));
    check(KSPGetPC(ksp, &preconditioner));
    if (own_blocks) {
        check(PCSetType(preconditioner, PCBJACOBI));
        PetscBool is_chosen = PETSC_FALSE;
        check(PetscOptionsHasName(nullptr, nullptr, "-sub_pc_type", &is_chosen));
        if (!is_chosen) check(PetscOptionsSetValue(nullptr, "-sub_pc_type", "icc"));
    } else {
        check(PCSetType(preconditioner, PCSHELL));
        check(PCShellSetContext(preconditioner, this));
        check(PCShellSetApply(preconditioner, precondition));
    }
    check(KSPMonitorSet(ksp, tell_iteration, this, nullptr));
    check_options(KSPSetFromOptions(ksp), options.petsc);
    PetscBool is_cg = PETSC_FALSE, is_norm_chosen = PETSC_FALSE;
    check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(ksp), KSPCG, &is_cg));
    check(PetscOptionsHasName(nullptr, nullptr, "-ksp_norm_type", &is_norm_chosen));
    if (is_cg && !is_norm_chosen) check(KSPSetNormType(ksp, KSP_NORM_NATURAL));
}

double LinearSystem::Impl::norm(Vec values) const {
    double norm = 0;
    check(VecNorm(values, NORM_2, &norm));
    return norm;
}

// Returns |values| in the norm of the inverse of the matrix, as it is preconditioned.
double LinearSystem::Impl::energy_norm(Vec values) const {
    PC preconditioner = nullptr;
    Vec preconditioned = nullptr;
    double square = 0;
    check(KSPGetPC(ksp, &preconditioner));
    check(VecDuplicate(values, &preconditioned));
    const PetscErrorCode applied = PCApply(preconditioner, values, preconditioned);
    if (applied == 0) check(VecDot(values, preconditioned, &square));
    check(VecDestroy(&preconditioned));
    check_call(applied);
    return std::sqrt(square);
}

// Makes the multigrid, unless the case has told PETSc to take another preconditioner.
void LinearSystem::Impl::make_multigrid() {
    PC preconditioner = nullptr;
    PetscBool is_ours = PETSC_FALSE;
    check(KSPGetPC(ksp, &preconditioner));
    check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(preconditioner), PCSHELL, &is_ours));
    if (is_ours && !multigrid) multigrid = multigrid_for(problem, stiffness, 0);
}

LinearSystem::LinearSystem(const ElasticProblem& problem, const SolverOptions& options)
    : impl_(std::make_unique<Impl>(problem, options)) {
    impl_->assemble();
    impl_->prepare_solver();
}

LinearSystem::~LinearSystem() = default;

const AssemblySeconds& LinearSystem::seconds() const { return impl_->seconds; }
std::int64_t LinearSystem::unprepared_entries() const { return impl_->unprepared; }

double LinearSystem::set_up() {
    const Stopwatch stopwatch;
    impl_->make_multigrid();
    const PetscErrorCode prepared = KSPSetUp(impl_->ksp);  // preconditioners of blocks read their options here
    if (!impl_->failure) check_options(prepared, impl_->options.petsc);
    impl_->check_call(prepared);
    refuse_unknown_options();
    return stopwatch.seconds();
}

void LinearSystem::Impl::set_right(const std::vector<double>& forces) {
    const FeSpace& space = *problem.space;
    std::vector<double> sums = forces;
    problem.frames.to_frames(sums);
    for (std::size_t dof = 0; dof < sums.size(); ++dof)
        sums[dof] = problem.is_held(dof) ? 0 : sums[dof] + stiffness.of_prescribed[dof];
    space.ownership().sum_to_owners(std::span(sums), 3);
    double* values = nullptr;
    check(VecGetArray(right, &values));
    for (std::int32_t dof = 0; dof < 3 * space.owned_count(); ++dof)
        values[dof] = problem.is_held(dof) ? stiffness.diagonal * problem.prescribed[dof] : sums[dof];
    check(VecRestoreArray(right, &values));
}

// Computes b - A u with long doubles: the rounding of a product with doubles would be as large as the loads of a
// slender body.
void LinearSystem::Impl::take_residual() {
    const double *found = nullptr, *wanted = nullptr;
    double* rest = nullptr;
    check(VecGetArrayRead(solution, &found));
    exact.assign(stiffness.matrix.size(), 0);
    std::copy_n(found, owned_size(), exact.begin());
    check(VecRestoreArrayRead(solution, &found));
    stiffness.matrix.multiply(exact, of_exact);
    check(VecGetArrayRead(right, &wanted));
    check(VecGetArrayWrite(residual, &rest));
    for (std::size_t dof = 0; dof < owned_size(); ++dof) rest[dof] = static_cast<double>(wanted[dof] - of_exact[dof]);
    check(VecRestoreArrayWrite(residual, &rest));
    check(VecRestoreArrayRead(right, &wanted));
}

// Solves by conjugate gradients with doubles, then again for the residual that rounding has left (wilkinson1963): a
// slender body needs that, since its stiffness times its displacements is far larger than its loads.
SolveOutcome LinearSystem::Impl::solve_refined() {
    SolveOutcome outcome;
    outcome.residual = 1;
    double tolerance = 0, absolute = 0, divergence = 0;
    PetscInt most_iterations = 0;
    check(KSPGetTolerances(ksp, &tolerance, &absolute, &divergence, &most_iterations));
    check(VecZeroEntries(solution));
    check(VecCopy(right, residual));
    const double of_right = norm(right), energy = energy_norm(right), goal = slack * options.rtol;
    for (bool is_better = true; is_better;) {
        iterations_before = outcome.iterations;
        const double fall = std::max(tolerance, part_of_the_rest * options.rtol / outcome.residual);
        check(KSPSetTolerances(ksp, iterations_before == 0 ? tolerance : fall, absolute, divergence,
                               most_iterations - iterations_before));
        check(VecZeroEntries(correction));
        check_call(KSPSolve(ksp, residual, correction));
        KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
        PetscInt iterations = 0;
        check(KSPGetConvergedReason(ksp, &reason));
        check(KSPGetIterationNumber(ksp, &iterations));
        outcome.reason = KSPConvergedReasons[reason];
        outcome.iterations += iterations;
        check(VecAXPY(solution, 1, correction));
        take_residual();
        const double before = outcome.residual, rest = energy_norm(residual);
        outcome.residual = energy > 0 ? rest / energy : rest;
        const double sizes = stiffness.norm * norm(solution) + of_right;
        outcome.backward_error = sizes > 0 ? norm(residual) / sizes : 0;
        outcome.is_of_rounding = reason > 0 && outcome.residual > goal && outcome.is_backward_stable();
        outcome.converged =
            reason > 0 && outcome.residual <= (outcome.is_of_rounding ? most_of_rounding * options.rtol : goal);
        is_better = reason > 0 && outcome.residual > goal && tolerance <= options.rtol &&
                    outcome.residual < part_of_the_rest * before;
        if (is_better) ++outcome.refinements;
    }
    check(KSPSetTolerances(ksp, tolerance, absolute, divergence, most_iterations));
    return outcome;
}

SolveOutcome LinearSystem::solve(const std::vector<double>& forces, std::vector<double>& displacement,
                                 const AfterIteration& after_iteration) {
    impl_->after_iteration = after_iteration;
    const ElasticProblem& problem = impl_->problem;
    const FeSpace& space = *problem.space;
    set_up();
    impl_->set_right(forces);
    const Stopwatch stopwatch;
    SolveOutcome outcome = impl_->solve_refined();
    outcome.solve_seconds = stopwatch.seconds();

    displacement.assign(3 * space.node_count(), 0);
    const double* found = nullptr;
    check(VecGetArrayRead(impl_->solution, &found));
    std::copy(found, found + 3 * space.owned_count(), displacement.begin());
    check(VecRestoreArrayRead(impl_->solution, &found));
    space.ownership().from_owners(std::span(displacement), 3);
    for (std::size_t dof = 0; dof < displacement.size(); ++dof)
        if (problem.is_held(dof)) displacement[dof] = problem.prescribed[dof];
    problem.frames.from_frames(displacement);
    return outcome;
}

}  // namespace kerf
