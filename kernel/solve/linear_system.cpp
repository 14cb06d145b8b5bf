// The only source that knows PETSc.
#include "solve/linear_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <petscksp.h>

#include "core/error.h"
#include "core/stopwatch.h"
#include "solve/block_rows.h"
#include "solve/turned_motions.h"

namespace kerf {

namespace {

// What PETSc has said first of a failure, which its codes on the way up no longer tell.
struct FirstFailure {
    bool is_of_memory = false;
    std::string text;
};
FirstFailure& first_failure() {
    static FirstFailure failure;
    return failure;
}

// The code of PetscMallocAlign() is a number of a line.
PetscErrorCode remember_failure(MPI_Comm, int, const char* function, const char*, PetscErrorCode code,
                                PetscErrorType type, const char* message, void*) {
    if (type == PETSC_ERROR_INITIAL)
        first_failure() = {code == PETSC_ERR_MEM || std::string_view(function).starts_with("PetscMalloc"),
                           fmt::format("{} in {}", message ? message : "", function)};
    return code;
}

// After a failure PETSc's objects are lost.
void check(PetscErrorCode code) {
    if (code == 0) return;
    const FirstFailure failure = first_failure();
    if (failure.is_of_memory)
        throw PetscFailure(ErrorCode::memory,
                           "PETSc ran out of memory. Use more ranks, more hosts, a coarser mesh or order 1.");
    throw PetscFailure(ErrorCode::internal,
                       fmt::format("PETSc failed with code {}: {}.", static_cast<int>(code), failure.text));
}

// The same where PETSc looks at the options of the case: it fails because of them.
void check_options(PetscErrorCode code, const std::string& options) {
    if (code == 0 || options.empty() || first_failure().is_of_memory) return check(code);
    const std::string& text = first_failure().text;
    throw PetscFailure(ErrorCode::usage, fmt::format("PETSc does not take the options '{}' of the case, petsc under "
                                                     "[solver]: {}. Correct them or leave them out.",
                                                     options, text.substr(0, text.find('\n'))));
}

// Local to global numbers of PETSc's rows, which have 32 bits (FeSpace sees to that).
PetscInt row_of(const FeSpace& space, std::int32_t node) { return static_cast<PetscInt>(space.row_of(node)); }

// Blocks of each row: in columns of this rank and of others, all and those from the diagonal on.
struct RoomForRows {
    std::vector<PetscInt> own, others, own_upper, others_upper;
};

// What other ranks add to a row is counted there: a few blocks at interfaces are counted twice.
RoomForRows room_for(const FeSpace& space, const BlockRows& rows) {
    enum { own, others, own_upper, others_upper };
    constexpr std::int64_t kinds = 4;
    std::vector<std::int32_t> counts(kinds * space.node_count(), 0);
    const std::vector<std::int64_t>& starts = space.rank_rows();
    for (std::int32_t n = 0; n < rows.row_count(); ++n) {
        const std::int64_t row = space.row_of(n);
        const auto after = std::upper_bound(starts.begin(), starts.end(), row);
        for (std::int64_t i = rows.first[n]; i < rows.first[n + 1]; ++i) {
            const std::int64_t column = space.row_of(rows.columns[i]);
            const bool is_own = column >= *(after - 1) && column < *after;
            ++counts[kinds * n + (is_own ? own : others)];
            if (column >= row) ++counts[kinds * n + (is_own ? own_upper : others_upper)];
        }
    }
    space.exchange().add_to_owners(std::span(counts), kinds);
    RoomForRows room;
    const std::int64_t all_own = space.owned_count(), all_others = space.total_rows() - all_own;
    for (std::int32_t n = 0; n < space.owned_count(); ++n) {
        const auto count = [&](int kind, std::int64_t most) -> PetscInt {
            return std::min<std::int64_t>(counts[kinds * n + kind], most);
        };
        room.own.push_back(count(own, all_own));
        room.others.push_back(count(others, all_others));
        room.own_upper.push_back(count(own_upper, all_own));
        room.others_upper.push_back(count(others_upper, all_others));
    }
    return room;
}

}  // namespace

void PetscSession::initialise(const MpiRanks& ranks) {
    PETSC_COMM_WORLD = ranks.handle();
    std::array<char*, 3> arguments = {const_cast<char*>("kerf-solve"), const_cast<char*>("-skip_petscrc"), nullptr};
    int count = 2;
    char** list = arguments.data();
    check(PetscInitialize(&count, &list, nullptr, nullptr));
    check(PetscPopSignalHandler());
}

void PetscSession::use_own_options() {
    check(PetscOptionsCreate(&options_));
    check(PetscOptionsPush(options_));
}

PetscSession::PetscSession(const MpiRanks& ranks, const std::string& options) {
    PetscBool is_running = PETSC_FALSE;
    check(PetscInitialized(&is_running));
    is_own_ = !is_running;
    if (is_own_)
        initialise(ranks);
    else
        use_own_options();
    check(PetscPushErrorHandler(remember_failure, nullptr));
    const bool are_options = options.empty() || options[0] == '-';
    if (are_options && PetscOptionsInsertString(nullptr, options.c_str()) == 0) return;
    end();
    throw Error(ErrorCode::usage, fmt::format("PETSc does not take the options '{}'.", options));
}

PetscSession::~PetscSession() { end(); }

void PetscSession::end() {
    if (is_own_) {
        PetscFinalize();
        return;
    }
    PetscPopErrorHandler();
    PetscOptionsPop();
    PetscOptionsDestroy(&options_);
}

namespace {

// Those of the case that nothing has asked for until the solver is set up.
void refuse_unknown_options() {
    PetscInt count = 0;
    char **names = nullptr, **values = nullptr;
    check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
    std::string unknown;
    for (PetscInt i = 0; i < count; ++i)
        if (std::string(names[i]) != "skip_petscrc")
            unknown += fmt::format("{}-{}", unknown.empty() ? "" : ", ", names[i]);
    check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
    if (!unknown.empty())
        throw Error(ErrorCode::usage, fmt::format("PETSc has no use for these options of the case: {}.", unknown));
}

}  // namespace

struct LinearSystem::Impl {
    Impl(const ElasticProblem& wanted, const SolverOptions& chosen) : problem(wanted), options(chosen) {}
    ~Impl() {
        KSPDestroy(&ksp);
        VecDestroy(&right);
        VecDestroy(&solution);
        VecDestroy(&residual);
        MatDestroy(&matrix);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void assemble();
    void create_matrix(const BlockRows& rows);
    void insert(const BlockRows& rows);
    double mean_diagonal(const BlockRows& rows) const;
    void prepare_solver();
    static PetscErrorCode tell_iteration(KSP ksp, PetscInt iteration, PetscReal residual, void* self);
    void give_rigid_motions();

    const ElasticProblem& problem;
    SolverOptions options;
    Mat matrix = nullptr;
    KSP ksp = nullptr;
    Vec right = nullptr, solution = nullptr, residual = nullptr;
    std::vector<double> of_prescribed;  // #dof: what held displacements put on the right, shares of ranks
    double diagonal = 1;                // of held degrees of freedom
    double norm = 0;                    // of the matrix, the largest sum of a row: no less than its largest eigenvalue
    bool is_symmetric_half = false;
    AssemblySeconds seconds;
    AfterIteration after_iteration;
    double residual_at_start = 0;
    std::int64_t unprepared = 0;
};

void LinearSystem::Impl::create_matrix(const BlockRows& rows) {
    const FeSpace& space = *problem.space;
    const auto own = static_cast<PetscInt>(3 * space.owned_count());
    is_symmetric_half = options.preconditioner == "icc";  // multigrid wants all of it
    check(MatCreate(space.ranks().handle(), &matrix));
    check(MatSetSizes(matrix, own, own, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetBlockSize(matrix, 3));
    check(MatSetType(matrix, is_symmetric_half ? MATSBAIJ : MATAIJ));
    const RoomForRows room = room_for(space, rows);
    check(MatXAIJSetPreallocation(matrix, 3, room.own.data(), room.others.data(), room.own_upper.data(),
                                  room.others_upper.data()));
    if (is_symmetric_half) check(MatSetOption(matrix, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
    check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
    check(MatSetOption(matrix, MAT_ROW_ORIENTED, PETSC_TRUE));
}

double LinearSystem::Impl::mean_diagonal(const BlockRows& rows) const {
    std::array<double, 2> sum = {0, static_cast<double>(3 * problem.space->owned_count())};
    for (std::int32_t n = 0; n < rows.row_count(); ++n)
        for (std::int64_t i = rows.first[n]; i < rows.first[n + 1]; ++i)
            if (rows.columns[i] == n) {
                const double* block = &rows.values[9 * i];
                sum[0] += block[0] + block[4] + block[8];
            }
    problem.space->ranks().all_reduce(std::span<double>(sum), Reduction::sum);
    return sum[0] / sum[1];
}

void LinearSystem::Impl::insert(const BlockRows& rows) {
    const FeSpace& space = *problem.space;
    of_prescribed.assign(3 * space.node_count(), 0);
    std::vector<PetscInt> columns;
    std::vector<double> values;  // of one row of blocks: three rows of numbers
    for (std::int32_t n = 0; n < rows.row_count(); ++n) {
        const std::int64_t begin = rows.first[n], end = rows.first[n + 1];
        const std::int64_t width = 3 * (end - begin);
        columns.clear();
        values.assign(3 * width, 0);
        for (std::int64_t i = begin; i < end; ++i) {
            const std::int32_t column = rows.columns[i];
            columns.push_back(row_of(space, column));
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 3; ++c) {
                    const double value = rows.values[9 * i + 3 * r + c];
                    if (problem.is_held(3 * n + r)) continue;
                    if (problem.is_held(3 * column + c))
                        of_prescribed[3 * n + r] -= value * problem.prescribed[3 * column + c];
                    else
                        values[r * width + 3 * (i - begin) + c] = value;
                }
            if (column == n && n < space.owned_count())
                for (std::size_t r = 0; r < 3; ++r)
                    if (problem.is_held(3 * n + r)) values[r * width + 3 * (i - begin) + r] = diagonal;
        }
        const PetscInt row = row_of(space, n);
        check(MatSetValuesBlocked(matrix, 1, &row, static_cast<PetscInt>(columns.size()), columns.data(), values.data(),
                                  ADD_VALUES));
    }
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    MatInfo info;
    check(MatGetInfo(matrix, MAT_GLOBAL_SUM, &info));
    unprepared = info.mallocs;
}

void LinearSystem::Impl::assemble() {
    Stopwatch stopwatch;
    const BlockRows rows = stiffness_of_rank(problem);
    seconds.elements = stopwatch.lap();
    diagonal = mean_diagonal(rows);
    create_matrix(rows);
    insert(rows);
    check(MatNorm(matrix, NORM_INFINITY, &norm));
    check(MatCreateVecs(matrix, &solution, &right));
    check(VecDuplicate(right, &residual));
    seconds.insert = stopwatch.lap();
}

void LinearSystem::Impl::give_rigid_motions() {
    const FeSpace& space = *problem.space;
    Vec places = nullptr;
    check(MatCreateVecs(matrix, &places, nullptr));
    double* values = nullptr;
    check(VecGetArray(places, &values));
    for (std::int32_t n = 0; n < space.owned_count(); ++n)
        for (int c = 0; c < 3; ++c) values[3 * n + c] = space.points()[n][c];
    check(VecRestoreArray(places, &values));
    check(VecSetBlockSize(places, 3));
    MatNullSpace motions = nullptr;
    check(MatNullSpaceCreateRigidBody(places, &motions));
    if (space.ranks().all_reduce(problem.frames.empty() ? 0 : 1, Reduction::largest) > 0)
        check(turn_into_frames(problem.frames, &motions));
    check(MatSetNearNullSpace(matrix, motions));
    check(MatNullSpaceDestroy(&motions));
    check(VecDestroy(&places));
}

// Called by PETSc, with the norm that ends the iterations.
PetscErrorCode LinearSystem::Impl::tell_iteration(KSP, PetscInt iteration, PetscReal residual, void* self) {
    Impl& impl = *static_cast<Impl*>(self);
    if (iteration == 0) impl.residual_at_start = residual;
    if (impl.after_iteration && impl.residual_at_start > 0)
        impl.after_iteration(iteration, residual / impl.residual_at_start);
    return 0;
}

void LinearSystem::Impl::prepare_solver() {
    PC preconditioner = nullptr;
    check(KSPCreate(problem.space->ranks().handle(), &ksp));
    check(KSPSetOperators(ksp, matrix, matrix));
    check(KSPSetType(ksp, KSPCG));
    check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(ksp, options.rtol, 0, PETSC_DEFAULT, options.max_iterations));
    check(KSPGetPC(ksp, &preconditioner));
    if (options.preconditioner == "gamg") {
        give_rigid_motions();
        check(PCSetType(preconditioner, PCGAMG));
    } else {
        check(PCSetType(preconditioner, PCBJACOBI));
        PetscBool is_chosen = PETSC_FALSE;
        check(PetscOptionsHasName(nullptr, nullptr, "-sub_pc_type", &is_chosen));
        if (!is_chosen) check(PetscOptionsSetValue(nullptr, "-sub_pc_type", "icc"));
    }
    check(KSPMonitorSet(ksp, tell_iteration, this, nullptr));
    check_options(KSPSetFromOptions(ksp), options.petsc);
}

LinearSystem::LinearSystem(const ElasticProblem& problem, const SolverOptions& options)
    : impl_(std::make_unique<Impl>(problem, options)) {
    impl_->assemble();
    impl_->prepare_solver();
}

LinearSystem::~LinearSystem() = default;

const AssemblySeconds& LinearSystem::seconds() const { return impl_->seconds; }
std::int64_t LinearSystem::unprepared_entries() const { return impl_->unprepared; }

SolveOutcome LinearSystem::solve(const std::vector<double>& forces, std::vector<double>& displacement,
                                 const AfterIteration& after_iteration) {
    impl_->after_iteration = after_iteration;
    const ElasticProblem& problem = impl_->problem;
    const FeSpace& space = *problem.space;
    SolveOutcome outcome;
    std::vector<double> right = forces;
    problem.frames.to_frames(right);
    for (std::size_t dof = 0; dof < right.size(); ++dof)
        right[dof] = problem.is_held(dof) ? 0 : right[dof] + impl_->of_prescribed[dof];
    space.exchange().add_to_owners(std::span(right), 3);
    double* values = nullptr;
    check(VecGetArray(impl_->right, &values));
    for (std::int32_t dof = 0; dof < 3 * space.owned_count(); ++dof)
        values[dof] = problem.is_held(dof) ? impl_->diagonal * problem.prescribed[dof] : right[dof];
    check(VecRestoreArray(impl_->right, &values));

    Stopwatch stopwatch;
    const PetscErrorCode prepared = KSPSetUp(impl_->ksp);  // preconditioners of blocks read their options here
    if (prepared == PETSC_ERR_ARG_UNKNOWN_TYPE) check_options(prepared, impl_->options.petsc);
    check(prepared);
    refuse_unknown_options();
    outcome.setup_seconds = stopwatch.lap();
    check(VecZeroEntries(impl_->solution));
    check(KSPSolve(impl_->ksp, impl_->right, impl_->solution));
    outcome.solve_seconds = stopwatch.lap();

    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(impl_->ksp, &reason));
    outcome.reason = KSPConvergedReasons[reason];
    PetscInt iterations = 0;
    check(KSPGetIterationNumber(impl_->ksp, &iterations));
    outcome.iterations = iterations;
    double norm = 0, of_right = 0, of_solution = 0;
    check(MatMult(impl_->matrix, impl_->solution, impl_->residual));
    check(VecAXPY(impl_->residual, -1, impl_->right));
    check(VecNorm(impl_->residual, NORM_2, &norm));
    check(VecNorm(impl_->right, NORM_2, &of_right));
    check(VecNorm(impl_->solution, NORM_2, &of_solution));
    outcome.residual = of_right > 0 ? norm / of_right : norm;
    outcome.rounding = of_right > 0 ? 2 * 0x1p-53 * (impl_->norm * of_solution / of_right + 1) : 0;
    const double allowed = slack * impl_->options.rtol + outcome.rounding;
    outcome.converged = reason > 0 && std::isfinite(outcome.residual) && outcome.residual <= allowed;

    displacement.assign(3 * space.node_count(), 0);
    const double* found = nullptr;
    check(VecGetArrayRead(impl_->solution, &found));
    std::copy(found, found + 3 * space.owned_count(), displacement.begin());
    check(VecRestoreArrayRead(impl_->solution, &found));
    space.exchange().to_ghosts(std::span(displacement), 3);
    for (std::size_t dof = 0; dof < displacement.size(); ++dof)
        if (problem.is_held(dof)) displacement[dof] = problem.prescribed[dof];
    problem.frames.from_frames(displacement);
    return outcome;
}

}  // namespace kerf
