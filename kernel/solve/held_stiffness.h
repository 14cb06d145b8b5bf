// The matrix of the equations of an elastic body, and its preconditioner.
#pragma once

#include <memory>
#include <vector>

#include "solve/elastic_problem.h"
#include "solve/multigrid.h"

namespace kerf {

/// Stiffness with rows and columns of held degrees of freedom replaced by a diagonal as large as the others.
struct HeldStiffness {
    LevelMatrix<3> matrix;
    std::vector<double> of_prescribed;  ///< #dof: what held displacements put on the right; ranks have shares
    double diagonal = 1;                ///< of held degrees of freedom
    double norm = 0;                    ///< a bound of the largest eigenvalue of the matrix
};

/// `share`: the stiffness of this rank's elements over all local nodes. Collective. O(n).
HeldStiffness hold_stiffness(const ElasticProblem& problem, SymmetricBlocks<3> share);

/// A multigrid that knows the rigid motions; `stiffness`, to which so many times the mass was added, and `problem` have
/// to outlive it. Collective. O(n).
std::unique_ptr<MultigridLevel> multigrid_for(const ElasticProblem& problem, const HeldStiffness& stiffness,
                                              double mass_factor);

}  // namespace kerf
