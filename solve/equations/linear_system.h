// The equations of an elastic body, distributed over the ranks, and their solution by PETSc.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solve/equations/elastic_problem.h"
#include "solve/equations/inside/petsc_session.h"

namespace kerf {

/// The convergence and the accuracy of a solution.
struct SolveOutcome {
    /// Whether PETSc says so and the residual is at most LinearSystem::slack * rtol, or, where is_of_rounding, at most
    /// LinearSystem::most_of_rounding * rtol.
    bool converged = false;
    bool is_of_rounding = false;  ///< PETSc has converged, and rounding keeps the residual above rtol
    std::string reason;           ///< PETSc's name for the reason of its end
    int iterations = 0;           ///< with those of refinements
    int refinements = 0;          ///< number of solutions for a residual that rounding had left
    /// |b - A u| over |b|, computed anew from the solution with more digits than it has, in the norm of the inverse of
    /// A as it is preconditioned: about the error of u in the energy norm beside u. |A u| where b is zero.
    double residual = 0;
    /// |b - A u| over |A| |u| + |b|: u solves equations exactly whose A and b differ by so little (rigal1967). The norm
    /// of A is its largest sum of a row, those of vectors are Euclidean.
    double backward_error = 0;
    /// Whether the backward error is about that of one rounding of u, as small as that of a direct solution: A and b
    /// determine u no better.
    bool is_backward_stable() const { return backward_error <= 2 * 0x1p-53; }
    double solve_seconds = 0;
};

/// Called after each iteration with its number and the residual beside that of the start. Must not throw.
using AfterIteration = std::function<void(int iteration, double residual)>;

struct AssemblySeconds {
    double elements = 0;  ///< stiffness of elements, summed by rows
    double insert = 0;    ///< held degrees of freedom taken out, and PETSc's matrix made
};

/// PETSc's conjugate gradients on HeldStiffness, preconditioned by our multigrid ("multigrid") or by PETSc's incomplete
/// Cholesky factors of the ranks' blocks ("icc"), until the residual has fallen by rtol: whatever PETSc was told
/// by SolverOptions::petsc, its residual is compared with rtol after each solution. Bytes of the result are the same
/// for the same number of ranks; between numbers of ranks they agree within the tolerance.
class LinearSystem {
 public:
    /// The true residual over rtol above which a solution is refined. Conjugate gradients end by a residual that they
    /// update, and rounding takes it away from the true one (greenbaum1997).
    static constexpr double slack = 1.1;
    static constexpr double most_of_rounding = 10;  ///< the same where only rounding is left

    /// Assembles the equations. Collective. O(n). 9 doubles for each pair of nodes of an element. Throws Error(memory)
    /// or Error(internal), on all ranks alike.
    LinearSystem(const ElasticProblem& problem, const SolverOptions& options);
    ~LinearSystem();
    LinearSystem(const LinearSystem&) = delete;
    LinearSystem& operator=(const LinearSystem&) = delete;

    /// Makes the preconditioner, unless that is done, and returns the seconds that it took. Collective.
    double set_up();
    /// Finds the displacements for nodal forces, of which ranks have shares: 3 for each local node, held ones as
    /// prescribed. Calls `after_iteration` on every rank.
    SolveOutcome solve(const std::vector<double>& forces, std::vector<double>& displacement,
                       const AfterIteration& after_iteration = {});
    const AssemblySeconds& seconds() const;
    /// The number of matrix entries without prepared room: 0, or assembly is slow.
    std::int64_t unprepared_entries() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace kerf
