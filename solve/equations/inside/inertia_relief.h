// Inertia relief: loads accelerate a body that nothing holds, and it deforms under the rest of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solve/equations/inside/body_motions.h"
#include "solve/space/space_bodies.h"

namespace kerf {

struct ElasticProblem;
struct ProblemCase;

/// The balance of bodies that supports leave free. Their free motions are balanced by the inertia of the body and fixed
/// at as many displacements of nodes, where no reaction is left then. Displacements are told without the free motions:
/// those that are left have no momentum.
class InertiaRelief {
 public:
    /// A problem in which no body is free.
    InertiaRelief() = default;
    /// Finds the free motions of the problem and, if there are any, holds them by a support of its own, the last one.
    /// Throws Error(usage), on all ranks alike, for a free body without mass. Collective.
    InertiaRelief(ElasticProblem& problem, const SpaceBodies& bodies);

    bool is_needed() const { return is_needed_; }

    /// Adds the forces of inertia to those of the case. `add_force` takes a force at a node, on cells of a part.
    /// Collective.
    using AddForce = std::function<void(std::size_t part, std::int32_t node, const Vec3& force)>;
    void balance(const ElasticProblem& problem, ProblemCase& of_case, const AddForce& add_force) const;

    /// Takes the free motions out of displacements of the local nodes. Collective.
    void remove_motions(const ElasticProblem& problem, std::vector<double>& displacement) const;

 private:
    using Motion = Eigen::Matrix<double, 6, 1>;

    void measure_masses(const ElasticProblem& problem);
    void fix_motions(ElasticProblem& problem) const;
    // Returns for each body the degree of freedom, numbered over all ranks, that the motions in `left` move most.
    std::vector<std::int64_t> next_to_fix(const ElasticProblem& problem,
                                          const std::vector<Eigen::MatrixXd>& left) const;
    // Returns the free motion of each body that has the given momenta, six for each body.
    std::vector<Motion> with_momenta(const std::vector<double>& momenta) const;

    SpaceBodies bodies_;
    std::vector<BodyMotions> motions_;
    std::vector<Eigen::Matrix<double, 6, 6>> masses_;  // of the six motions of each body
    bool is_needed_ = false;
};

}  // namespace kerf
