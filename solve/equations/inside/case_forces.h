// The nodal forces of each set of loads.
#pragma once

#include <string>
#include <vector>

#include "solve/equations/elastic_problem.h"

namespace kerf {

/// Fills ElasticProblem::cases, once the rest of the problem is there.
class CaseForces {
 public:
    /// `region_of_material`: as place_materials() returns it.
    CaseForces(ElasticProblem& problem, const MeshOutline& outline, const ElasticCase& wanted,
               const SurfaceSelector& selector, std::vector<std::int32_t> region_of_material)
        : problem_(problem),
          space_(*problem.space),
          outline_(outline),
          wanted_(wanted),
          selector_(selector),
          region_of_material_(std::move(region_of_material)) {}

    /// Adds the case `name`. Throws Error(usage), on all ranks alike, for names that the mesh does not have, and for
    /// materials without density or expansion where these are needed. Collective.
    void add_case(const std::string& name);
    /// Adds a sum of cases that have been added, times factors.
    void add_combination(const Combination& combination);

 private:
    ProblemCase& current() { return problem_.cases.back(); }
    void add_force(std::size_t p, std::int32_t node, const Vec3& force);
    void add_force_at(std::int64_t row, const Vec3& force);
    void add_load(const Load& load);
    void add_gravity(const Vec3& acceleration);
    void add_rotation(const Rotation& rotation);
    void add_temperature(const Temperature& temperature);
    void add_thermal_forces();
    void require_density(const char* what) const;

    ElasticProblem& problem_;
    const FeSpace& space_;
    const MeshOutline& outline_;
    const ElasticCase& wanted_;
    const SurfaceSelector& selector_;
    std::vector<std::int32_t> region_of_material_;
};

}  // namespace kerf
