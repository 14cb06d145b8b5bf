// The matrix of the equations of an elastic body, and its preconditioner.
#pragma once

#include <memory>
#include <vector>

#include "solve/equations/elastic_problem.h"
#include "solve/multigrid/multigrid.h"

namespace kerf {

/// The stiffness with rows and columns of held degrees of freedom replaced by a diagonal as large as the others.
struct HeldStiffness {
    LevelMatrix<3> matrix;
    std::vector<double> of_prescribed;  ///< #dof: the right side's share of held displacements; ranks have shares
    double diagonal = 1;                ///< entry of held degrees of freedom
    double norm = 0;                    ///< a bound of the largest eigenvalue of the matrix
};

/// Takes the held degrees of freedom out of the stiffness. `share`: the stiffness of this rank's elements over all
/// local nodes. Collective. O(n).
HeldStiffness hold_stiffness(const ElasticProblem& problem, SymmetricBlocks<3> share);

/// Returns a multigrid that knows the rigid motions. `problem` and `stiffness`, to which the mass was added
/// `mass_factor` times, have to outlive it. Collective. O(n).
std::unique_ptr<MultigridLevel> multigrid_for(const ElasticProblem& problem, const HeldStiffness& stiffness,
                                              double mass_factor);

}  // namespace kerf
