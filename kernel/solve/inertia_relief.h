// Bodies that nothing holds: what pulls at them accelerates them, and they deform under the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solve/body_motions.h"
#include "solve/space_bodies.h"

namespace kerf {

struct ElasticProblem;
struct ProblemCase;

/// Free motions are balanced by the inertia of the body and fixed at as many displacements of nodes, where no force is
/// left then; displacements are told without the free motions, which leaves those that have no momentum.
class InertiaRelief {
 public:
    /// Nothing is free.
    InertiaRelief() = default;
    /// Holds the free motions of the problem: its last support, if there are any. Throws Error(usage), on all ranks
    /// alike, for a free body without mass. Collective.
    InertiaRelief(ElasticProblem& problem, const SpaceBodies& bodies);

    bool is_needed() const { return is_needed_; }

    /// Adds the forces of inertia to those of the case. `add_force`: at a node, on cells of a part. Collective.
    using AddForce = std::function<void(std::size_t part, std::int32_t node, const Vec3& force)>;
    void balance(const ElasticProblem& problem, ProblemCase& of_case, const AddForce& add_force) const;

    /// Takes free motions out of displacements of the local nodes. Collective.
    void remove_motions(const ElasticProblem& problem, std::vector<double>& displacement) const;

 private:
    using Motion = Eigen::Matrix<double, 6, 1>;

    void measure_masses(const ElasticProblem& problem);
    void fix_motions(ElasticProblem& problem) const;
    // The displacement, as a row of all ranks, at which the motions that are left of each body are largest.
    std::vector<std::int64_t> next_to_fix(const ElasticProblem& problem,
                                          const std::vector<Eigen::MatrixXd>& left) const;
    // Free motions with these momenta of motions: six of each body.
    std::vector<Motion> with_momenta(const std::vector<double>& momenta) const;

    SpaceBodies bodies_;
    std::vector<BodyMotions> motions_;
    std::vector<Eigen::Matrix<double, 6, 6>> masses_;  // of motions
    bool is_needed_ = false;
};

}  // namespace kerf
