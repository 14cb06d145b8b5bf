// Modes by the block eigensolver and the multigrid.
#pragma once

#include <memory>

#include "solve/equations/inside/held_stiffness.h"
#include "solve/equations/inside/mass_matrix.h"
#include "solve/equations/modes.h"
#include "solve/multigrid/block_eigensolver.h"

namespace kerf {

/// The work of find_modes(): finds the lowest eigenvalues of K + s M and M.
class ModeSolver {
 public:
    /// Assembles the equations and their multigrid for `count` modes. Collective.
    ModeSolver(const ElasticProblem& problem, int count);

    /// Finds the modes. Collective. Throws as find_modes() does.
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

}  // namespace kerf
