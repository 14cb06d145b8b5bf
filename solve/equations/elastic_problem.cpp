#include "solve/equations/elastic_problem.h"

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "solve/equations/inside/case_forces.h"
#include "solve/equations/inside/hold_supports.h"
#include "solve/equations/inside/place_materials.h"
#include "solve/equations/inside/rigid_motions.h"

namespace kerf {

namespace {

void add_springs(ElasticProblem& problem, const std::vector<Spring>& springs, const SurfaceSelector& selector) {
    problem.first_spring = count_of(problem.supports);
    problem.springs.springs = springs;
    for (std::size_t s = 0; s < springs.size(); ++s) {
        const std::vector<SurfaceFacet> facets =
            selector.facets(springs[s].where, fmt::format("Spring '{}'", springs[s].name));
        for (const SurfaceFacet& facet : facets) problem.springs.facets.push_back({s, facet.part, facet.facet});
        problem.supports.push_back(springs[s].name);
        problem.places.push_back(centre_of(*problem.space, facets));
    }
}

// Refuses combinations where supports prescribe displacements that are not zero: these would be multiplied, too.
void require_sums_of_loads(const ElasticCase& wanted) {
    if (wanted.combinations.empty()) return;
    for (const Support& support : wanted.supports)
        for (const std::optional<double>& displacement : support.displacement)
            if (displacement.value_or(0) != 0)
                throw Error(ErrorCode::usage,
                            fmt::format("Support '{}' moves the body, in every case: a [[combination]], which adds up "
                                        "cases, would move it as often. Leave one of them out.",
                                        support.name));
}

}  // namespace

ElasticProblem make_free_problem(const FeSpace& space, const Material& material) {
    ElasticProblem problem;
    problem.space = &space;
    problem.materials = {material};
    problem.support_of.assign(3 * space.node_count(), ElasticProblem::free);
    problem.prescribed.assign(3 * space.node_count(), 0);
    return problem;
}

ElasticProblem make_problem(const FeSpace& space, const MeshOutline& outline, const ElasticCase& wanted) {
    require_sums_of_loads(wanted);
    const SurfaceSelector selector(space, outline.patch_names);
    const SpaceBodies bodies = find_bodies(space);
    ElasticProblem problem = make_free_problem(space, wanted.materials.front().material);
    std::vector<std::int32_t> regions = place_materials(problem, outline, wanted, selector, bodies);
    hold_supports(problem, wanted.supports, selector);
    add_springs(problem, wanted.springs, selector);
    if (wanted.solver.inertia_relief && !wanted.may_float)
        problem.relief = InertiaRelief(problem, bodies);
    else if (!wanted.may_float)
        require_supported(problem, bodies);
    CaseForces cases(problem, outline, wanted, selector, std::move(regions));
    for (const std::string& name : wanted.names()) cases.add_case(name);
    for (const Combination& combination : wanted.combinations) cases.add_combination(combination);
    return problem;
}

}  // namespace kerf
