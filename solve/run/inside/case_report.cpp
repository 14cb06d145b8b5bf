// Sums, energies and extremes of the solution of a case, for the mesh and for each of several regions. Stresses are
// compared at nodes, where each part has averages; the least safety is the inverse of the largest von Mises stress
// beside the yield stress of the material of a cell at the node. The imbalance is the size of the sum of loads,
// reactions and inertia beside the largest of these. The forces of temperatures, which add up to zero, count for that
// scale by the sum of their sizes, so that a case of temperatures alone has one.
#include "solve/run/inside/case_report.h"

#include <algorithm>

namespace kerf {

namespace {

struct StressExtremes {
    LargestPlace von_mises;
    LargestPlace use_of_yield;  // von Mises stress over yield stress
};

std::optional<Extreme> safety_of(const LargestPlace& use_of_yield, MpiRanks& ranks) {
    const std::optional<Extreme> most = use_of_yield.of_all(ranks);
    if (!most || most->value <= 0) return std::nullopt;
    return Extreme{1 / most->value, most->place};
}

class CaseResults {
 public:
    CaseResults(const ElasticProblem& problem, const CaseSolution& solution, std::size_t number)
        : problem_(problem), space_(*problem.space), solution_(solution), number_(number) {}

    void balance(const HeldForces& held, CaseReport& report) const {
        const ProblemCase& of_case = problem_.cases[number_];
        for (std::size_t dof = 0; dof < of_case.forces.size(); ++dof) report.load[dof % 3] += of_case.forces[dof];
        space_.ranks().all_reduce(std::span(report.load.data(), 3), Reduction::sum);
        report.inertia = of_case.inertia;
        report.load -= report.inertia;
        for (std::size_t s = 0; s < held.supports(); ++s) report.reactions.push_back(held.of(s));
        Vec3 sum = report.load + report.inertia;
        double scale = std::max({report.load.norm(), report.inertia.norm(), size_of_thermal_forces()});
        for (const ForceAndMoment& reaction : report.reactions) {
            sum += reaction.force;
            scale = std::max(scale, reaction.force.norm());
        }
        report.imbalance = scale > 0 ? sum.norm() / scale : 0;
        report.relieved = of_case.relieved;
        for (const auto& [of, factor] : of_case.factors) report.factors.emplace_back(problem_.cases[of].name, factor);
    }

    // Returns the sum of the sizes of nodal forces, those of loads with those of temperatures, which alone add up to
    // zero; 0 without temperatures.
    double size_of_thermal_forces() const {
        if (problem_.cases[number_].thermal.empty()) return 0;
        std::vector<double> forces = problem_.cases[number_].forces;
        space_.ownership().sum_to_owners(std::span(forces), 3);
        double size = 0;
        for (std::int32_t n = 0; n < space_.owned_count(); ++n) size += Eigen::Map<const Vec3>(&forces[3 * n]).norm();
        return space_.ranks().all_reduce(size, Reduction::sum);
    }

    // Returns the extremes of the mesh, then those of its regions.
    std::vector<StressExtremes> stresses(std::size_t regions) const {
        std::vector<StressExtremes> all(1 + regions);
        std::vector<double> at_node;  // of a part: vertices, then edges
        for (std::size_t p = 0; p < space_.parts().size(); ++p) {
            const Part& part = space_.parts()[p];
            const PartStress& stress = solution_.stress.parts[p];
            at_node.clear();
            for (const SymmetricTensor& at_vertex : stress.at_vertex) at_node.push_back(von_mises(at_vertex));
            for (const SymmetricTensor& at_edge : stress.at_edge) at_node.push_back(von_mises(at_edge));
            const std::size_t vertices = stress.at_vertex.size();
            const auto tell = [&](LargestPlace StressExtremes::*of, double value, std::size_t n) {
                const Vec3& place = n < vertices ? part.mesh.vertices[n] : part.edge_nodes.points[n - vertices];
                (all[0].*of).tell(value, place);
                if (regions > 0) (all[1 + space_.region_of(p)].*of).tell(value, place);
            };
            for (std::size_t n = 0; n < at_node.size(); ++n) tell(&StressExtremes::von_mises, at_node[n], n);
            for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
                const double yield = problem_.material(p, t).yield;
                if (yield <= 0) continue;
                for (const std::int32_t v : part.mesh.tets[t])
                    tell(&StressExtremes::use_of_yield, at_node[v] / yield, v);
                if (stress.at_edge.empty()) continue;
                const auto nodes = part.nodes_of_tet(t);
                for (std::size_t i = 4; i < nodes.size(); ++i)
                    tell(&StressExtremes::use_of_yield, at_node[nodes[i]] / yield, nodes[i]);
            }
        }
        return all;
    }

    std::vector<double> energies(std::size_t regions) const {
        std::vector<double> energies(regions, 0);
        for (std::size_t p = 0; p < space_.parts().size() && regions > 0; ++p)
            energies[space_.region_of(p)] += solution_.stress.parts[p].energy;
        space_.ranks().all_reduce(std::span(energies), Reduction::sum);
        return energies;
    }

 private:
    const ElasticProblem& problem_;
    const FeSpace& space_;
    const CaseSolution& solution_;
    std::size_t number_;
};

}  // namespace

void report_case(const ElasticProblem& problem, const CaseSolution& solution, std::size_t number,
                 const std::vector<std::string>& regions, CaseReport& report) {
    MpiRanks& ranks = problem.space->ranks();
    const CaseResults results(problem, solution, number);
    const HeldForces held = reactions(problem, solution.displacement, number);
    results.balance(held, report);
    report.norms = solution.stress.norms;
    report.displacement = largest_displacement(*problem.space, solution.displacement);
    const std::vector<StressExtremes> stresses = results.stresses(regions.size());
    report.von_mises = stresses[0].von_mises.of_all(ranks).value_or(Extreme{});
    report.safety = safety_of(stresses[0].use_of_yield, ranks);
    const std::vector<double> energies = results.energies(regions.size());
    for (std::size_t r = 0; r < regions.size(); ++r) {
        RegionResult& region = report.regions.emplace_back();
        region.name = regions[r];
        region.energy = energies[r];
        region.von_mises = stresses[1 + r].von_mises.of_all(ranks).value_or(Extreme{});
        region.safety = safety_of(stresses[1 + r].use_of_yield, ranks);
        for (std::size_t s = 0; s < held.supports(); ++s) region.reactions.push_back(held.of(s, r));
    }
}

}  // namespace kerf
