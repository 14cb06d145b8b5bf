// Stresses at nodes are averages of those of the cells around, weighted by volumes, in each material by itself. The
// error of a cell is the energy norm of the difference between its own stresses and better ones (Zienkiewicz and Zhu
// 1987, zienkiewicz1987): the averages for order 1, polynomials on patches for order 2 (Zienkiewicz and Zhu 1992,
// zienkiewicz1992), which tell the error alone. The difference is integrated exactly in straight cells: its square has
// degree 2 or 4. A reaction is the sum of the internal forces of cells at a held node, less the loads there, less the
// forces of springs there; each support has its share along the direction in which it pushes. Ranks add up sums at
// nodes that they share, so that no rank needs the cells of others.
#include "solve/equations/stress.h"

#include <algorithm>
#include <cmath>

#include "solve/equations/inside/element_stress.h"
#include "solve/equations/inside/material_nodes.h"
#include "solve/equations/inside/stress_patches.h"

namespace kerf {

namespace {

constexpr std::size_t stress_sums = 7;  // of a node: the sum of stresses times volumes, and of the volumes

bool holds_any_of(const ElasticProblem& problem, const std::array<std::int32_t, most_element_nodes>& nodes) {
    return std::any_of(nodes.begin(), nodes.begin() + element_nodes(problem.space->order()),
                       [&](std::int32_t node) { return problem.holds_any(node); });
}

// Adds the forces of springs on the body.
void add_spring_forces(const ElasticProblem& problem, const std::vector<double>& displacement, HeldForces& sums) {
    const FeSpace& space = *problem.space;
    for (const SurfaceSprings::Facet& facet : problem.springs.facets) {
        const FacetStiffness blocks = spring_stiffness(space, problem.springs, facet, space.order());
        const auto nodes = space.nodes_of_facet(facet.part, facet.facet);
        for (std::size_t a = 0; a < nodes.size(); ++a) {
            if (nodes[a] < 0) continue;
            Vec3 force = Vec3::Zero();
            for (std::size_t b = 0; b < nodes.size(); ++b)
                if (nodes[b] >= 0) force -= blocks[a][b] * Eigen::Map<const Vec3>(&displacement[3 * nodes[b]]);
            sums.add(problem.first_spring + facet.spring, space.region_of(facet.part), force, space.points()[nodes[a]]);
            problem.share_among_holders(nodes[a], -force, [&](std::int32_t support, const Vec3& share) {
                sums.add(support, space.region_of(facet.part), share, space.points()[nodes[a]]);
            });
        }
    }
}

// Returns the means over the cells around each node, in each material by itself.
std::vector<SymmetricTensor> average_stresses(const ElasticProblem& problem, const std::vector<double>& displacement,
                                              std::size_t number, const MaterialNodes& numbers) {
    const FeSpace& space = *problem.space;
    std::vector<double> sums(stress_sums * numbers.count(), 0);
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const ElementStress element(problem, displacement, number, p, t);
        const auto nodes = numbers.of(p, t);
        const double volume = element.element().volume();
        for (int i = 0; i < element_nodes(space.order()); ++i) {
            double* sum = &sums[stress_sums * nodes[i]];
            Eigen::Map<SymmetricTensor>{sum} += volume * element.stress(TetElement::place_of_node(i));
            sum[stress_sums - 1] += volume;
        }
    });
    numbers.ownership().sum_to_owners(std::span(sums), stress_sums);
    numbers.ownership().from_owners(std::span(sums), stress_sums);
    std::vector<SymmetricTensor> means(numbers.count(), SymmetricTensor::Zero());
    for (std::int32_t n = 0; n < numbers.count(); ++n) {
        const double* sum = &sums[stress_sums * n];
        if (sum[stress_sums - 1] > 0) means[n] = Eigen::Map<const SymmetricTensor>{sum} / sum[stress_sums - 1];
    }
    return means;
}

// Returns the points by which errors are integrated: the square of a difference has degree 4 for order 2, and degree 2
// for order 1.
std::span<const TetPoint> rule_of_errors(int order) {
    if (order == 1) return quadrature::four_points;
    return quadrature::fourteen_points;
}

class StressRecovery {
 public:
    StressRecovery(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number)
        : problem_(problem), space_(*problem.space), displacement_(displacement), number_(number) {
        for (const Part& part : space_.parts()) {
            PartStress& stress = field_.parts.emplace_back();
            stress.of_tet.assign(part.mesh.tets.size(), SymmetricTensor::Zero());
            stress.at_vertex.assign(part.mesh.vertices.size(), SymmetricTensor::Zero());
            stress.error.assign(part.mesh.tets.size(), 0);
            if (space_.order() == 2) stress.at_edge.assign(part.edge_nodes.points.size(), SymmetricTensor::Zero());
        }
    }

    StressField recover() {
        compare();
        std::array<double, 2> squares = {field_.norms.solution, field_.norms.error};
        space_.ranks().all_reduce(std::span<double>(squares), Reduction::sum);
        field_.norms = {std::sqrt(squares[0]), std::sqrt(squares[1])};
        return std::move(field_);
    }

 private:
    void compare() {
        const MaterialNodes numbers(problem_);
        const std::vector<SymmetricTensor> means = average_stresses(problem_, displacement_, number_, numbers);
        // Fitted stresses are nearer to the truth inside, but not where a surface has kinks: they tell the error alone.
        const std::vector<SymmetricTensor> better =
            space_.order() == 1 ? means : fit_stresses(problem_, displacement_, number_, numbers);
        const int nodes_each = element_nodes(space_.order());
        for_all_tets(space_, [&](std::size_t p, std::size_t t) {
            const ElementStress element(problem_, displacement_, number_, p, t);
            const double volume = element.element().volume();
            const auto nodes = numbers.of(p, t);
            SymmetricTensor mean = SymmetricTensor::Zero();
            double of_solution = 0, of_error = 0;
            for (const TetPoint& at : rule_of_errors(space_.order())) {
                const TetElement::Point point = element.element().point(at);
                const double weight = point.weight;
                const SymmetricTensor strain = element.strain(point), stress = stress_of(element.material(), strain);
                const TetElement::Shapes shapes = TetElement::shapes_at(space_.order(), at.place);
                SymmetricTensor difference = -stress;
                for (int i = 0; i < nodes_each; ++i) difference += shapes[i] * better[nodes[i]];
                mean += weight / volume * stress;
                of_solution += weight * contracted(stress, strain);
                of_error += weight * contracted(difference, strain_of_stress(element.material(), difference));
            }
            PartStress& of_part = field_.parts[p];
            of_part.of_tet[t] = mean;
            of_part.error[t] = std::sqrt(of_error);
            of_part.energy += of_solution / 2;
            field_.norms.solution += of_solution;
            field_.norms.error += of_error;
        });
        for (std::size_t p = 0; p < field_.parts.size(); ++p) tell_nodes(p, numbers, means);
    }

    // Sets the stresses at the nodes of a part. Of its materials that meet in a node the last one counts.
    void tell_nodes(std::size_t p, const MaterialNodes& numbers, const std::vector<SymmetricTensor>& means) {
        PartStress& of_part = field_.parts[p];
        const Part& part = space_.parts()[p];
        const std::size_t vertices = of_part.at_vertex.size();
        std::vector<std::int32_t> last(vertices + of_part.at_edge.size(), -1);
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
            const auto nodes = numbers.of(p, t);
            const Tetrahedron& corners = part.mesh.tets[t];
            for (std::size_t i = 0; i < 4; ++i) last[corners[i]] = std::max(last[corners[i]], nodes[i]);
            if (of_part.at_edge.empty()) continue;
            const auto of_tet = part.nodes_of_tet(t);
            for (std::size_t i = 4; i < 10; ++i) last[of_tet[i]] = std::max(last[of_tet[i]], nodes[i]);
        }
        for (std::size_t n = 0; n < last.size(); ++n)
            if (last[n] >= 0) (n < vertices ? of_part.at_vertex[n] : of_part.at_edge[n - vertices]) = means[last[n]];
    }

    const ElasticProblem& problem_;
    const FeSpace& space_;
    const std::vector<double>& displacement_;
    std::size_t number_;
    StressField field_;
};

}  // namespace

double EnergyNorms::relative() const {
    const double all = std::hypot(solution, error);
    return all > 0 ? error / all : 0;
}

StressField recover_stress(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number) {
    return StressRecovery(problem, displacement, number).recover();
}

HeldForces reactions(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number) {
    const FeSpace& space = *problem.space;
    HeldForces sums(problem.places, space.region_count());
    for_all_tets(space, [&](std::size_t p, std::size_t t) {
        const auto nodes = space.nodes_of(p, t);
        if (!holds_any_of(problem, nodes)) return;
        const std::array<Vec3, most_element_nodes> forces =
            ElementStress(problem, displacement, number, p, t).nodal_forces();
        for (int n = 0; n < element_nodes(space.order()); ++n)
            problem.share_among_holders(nodes[n], forces[n], [&](std::int32_t support, const Vec3& share) {
                sums.add(support, space.region_of(p), share, space.points()[nodes[n]]);
            });
    });
    if (number < problem.cases.size()) sums.add(-1, problem.cases[number].held_forces);
    add_spring_forces(problem, displacement, sums);
    space.ranks().all_reduce(sums.numbers(), Reduction::sum);
    return sums;
}

}  // namespace kerf
