// Modes by SLEPc.
#pragma once

#include <exception>
#include <memory>
#include <vector>

#include "solve/held_stiffness.h"
#include "solve/mass_matrix.h"
#include "solve/modes.h"

namespace kerf {

/// What find_modes() does where there is SLEPc. K + s M and M are scaled so that numbers have no units.
class ModeSolver {
 public:
    /// Collective. Throws as find_modes() does.
    ModeSolver(const ElasticProblem& problem, int count, const AfterModesIteration& after_iteration);
    ~ModeSolver();
    ModeSolver(const ModeSolver&) = delete;
    ModeSolver& operator=(const ModeSolver&) = delete;

    FoundModes find();

 private:
    struct Calls;
    Mode mode_at(int number, double lowest_elastic);
    double eigenvalue(int number);

    const ElasticProblem& problem_;
    int count_;
    const AfterModesIteration& after_iteration_;
    double mass_factor_;  // s
    HeldStiffness stiffness_;
    MassMatrix mass_;
    std::unique_ptr<MultigridLevel> multigrid_;
    double stiffness_scale_, mass_scale_;
    std::unique_ptr<Calls> calls_;
};

}  // namespace kerf
