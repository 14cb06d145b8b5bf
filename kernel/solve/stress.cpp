#include "solve/stress.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

constexpr std::size_t stress_sums = 7;  // of a node: the sum of stresses times volumes, and of the volumes

std::array<Vec3, most_element_nodes> values_at(const std::array<std::int32_t, most_element_nodes>& nodes, int order,
                                               const std::vector<double>& of_nodes) {
    std::array<Vec3, most_element_nodes> values;
    for (int i = 0; i < element_nodes(order); ++i) values[i] = Eigen::Map<const Vec3>(&of_nodes[3 * nodes[i]]);
    return values;
}

// The corners and the middles of edges of a tetrahedron.
Barycentric place_of_node(std::size_t i) {
    Barycentric place{};
    if (i < 4)
        place[i] = 1;
    else
        place[tet_edges[i - 4][0]] = place[tet_edges[i - 4][1]] = 0.5;
    return place;
}

// The stresses of one element.
class ElementStress {
 public:
    ElementStress(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number,
                  std::size_t p, std::size_t t)
        : element_(problem.space->element(p, t)),
          material_(problem.material(p, t)),
          values_(values_at(problem.space->nodes_of(p, t), problem.space->order(), displacement)),
          thermal_(problem.thermal_strain(number, p, t)) {}
    const TetElement& element() const { return element_; }
    const Material& material() const { return material_; }
    // Without what temperature stretches.
    SymmetricTensor strain(const Barycentric& point) const {
        SymmetricTensor strain = strain_of(element_.gradient_of(values_, point));
        strain.head<3>().array() -= thermal_;
        return strain;
    }
    SymmetricTensor stress(const Barycentric& point) const { return stress_of(material_, strain(point)); }
    // What holds the nodes against the stresses.
    std::array<Vec3, most_element_nodes> nodal_forces() const;

 private:
    TetElement element_;
    const Material& material_;
    std::array<Vec3, most_element_nodes> values_;
    double thermal_;
};

std::array<Vec3, most_element_nodes> ElementStress::nodal_forces() const {
    const std::size_t points = element_.order() == 1 ? 1 : quadrature_points.size();
    const double weight = element_.volume() / static_cast<double>(points);
    std::array<Vec3, most_element_nodes> forces;
    forces.fill(Vec3::Zero());
    for (std::size_t q = 0; q < points; ++q) {
        const SymmetricTensor s = stress(quadrature_points[q]);
        Eigen::Matrix3d matrix;
        matrix << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        const TetElement::Gradients gradients = element_.gradients_at(quadrature_points[q]);
        for (int n = 0; n < element_.node_count(); ++n) forces[n] += weight * matrix * gradients[n];
    }
    return forces;
}

bool holds_any_of(const ElasticProblem& problem, const std::array<std::int32_t, most_element_nodes>& nodes) {
    return std::any_of(nodes.begin(), nodes.begin() + element_nodes(problem.space->order()),
                       [&](std::int32_t node) { return problem.holds_any(node); });
}

// What springs do to the body.
void add_spring_forces(const ElasticProblem& problem, const std::vector<double>& displacement, HeldForces& sums) {
    const FeSpace& space = *problem.space;
    for (const SurfaceSprings::Facet& facet : problem.springs.facets) {
        const FacetStiffness blocks = spring_stiffness(space, problem.springs, facet);
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

class StressRecovery {
 public:
    StressRecovery(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number)
        : problem_(problem), space_(*problem.space), displacement_(displacement), number_(number) {
        for (const Part& part : space_.parts()) {
            PartStress& stress = field_.parts.emplace_back();
            stress.of_tet.assign(part.mesh.tets.size(), SymmetricTensor::Zero());
            stress.at_vertex.assign(part.mesh.vertices.size(), SymmetricTensor::Zero());
            stress.error.assign(part.mesh.tets.size(), 0);
        }
    }

    StressField recover() {
        for (std::size_t m = 0; m < problem_.materials.size(); ++m) {
            average(m);
            compare(m);
        }
        std::array<double, 2> squares = {field_.norms.solution, field_.norms.error};
        space_.ranks().all_reduce(std::span<double>(squares), Reduction::sum);
        field_.norms = {std::sqrt(squares[0]), std::sqrt(squares[1])};
        return std::move(field_);
    }

 private:
    bool is_of(std::size_t m, std::size_t p, std::size_t t) const {
        return problem_.material_of_tet.empty() || problem_.material_of_tet[p][t] == m;
    }

    // Mean stresses of a material at nodes.
    void average(std::size_t m) {
        sums_.assign(stress_sums * space_.node_count(), 0);
        for_all_tets(space_, [&](std::size_t p, std::size_t t) {
            if (!is_of(m, p, t)) return;
            const ElementStress element(problem_, displacement_, number_, p, t);
            const auto nodes = space_.nodes_of(p, t);
            const double volume = element.element().volume();
            for (int i = 0; i < element_nodes(space_.order()); ++i) {
                double* sum = &sums_[stress_sums * nodes[i]];
                Eigen::Map<SymmetricTensor>{sum} += volume * element.stress(place_of_node(i));
                sum[stress_sums - 1] += volume;
            }
        });
        space_.exchange().add_to_owners(std::span(sums_), stress_sums);
        space_.exchange().to_ghosts(std::span(sums_), stress_sums);
        for (std::int32_t n = 0; n < space_.node_count(); ++n) {
            double* sum = &sums_[stress_sums * n];
            if (sum[stress_sums - 1] > 0) Eigen::Map<SymmetricTensor>{sum} /= sum[stress_sums - 1];
        }
    }
    SymmetricTensor mean_at(std::int32_t node) const {
        return Eigen::Map<const SymmetricTensor>(&sums_[stress_sums * node]);
    }

    void compare(std::size_t m) {
        const int nodes_each = element_nodes(space_.order());
        for_all_tets(space_, [&](std::size_t p, std::size_t t) {
            if (!is_of(m, p, t)) return;
            const ElementStress element(problem_, displacement_, number_, p, t);
            const auto nodes = space_.nodes_of(p, t);
            const double weight = element.element().volume() / static_cast<double>(quadrature_points.size());
            SymmetricTensor mean = SymmetricTensor::Zero();
            double of_solution = 0, of_error = 0;
            for (const Barycentric& point : quadrature_points) {
                const SymmetricTensor strain = element.strain(point), stress = stress_of(element.material(), strain);
                const TetElement::Shapes shapes = TetElement::shapes_at(space_.order(), point);
                SymmetricTensor difference = -stress;
                for (int i = 0; i < nodes_each; ++i) difference += shapes[i] * mean_at(nodes[i]);
                mean += stress / static_cast<double>(quadrature_points.size());
                of_solution += weight * contracted(stress, strain);
                of_error += weight * contracted(difference, strain_of_stress(element.material(), difference));
            }
            PartStress& of_part = field_.parts[p];
            of_part.of_tet[t] = mean;
            of_part.error[t] = std::sqrt(of_error);
            of_part.energy += of_solution / 2;
            field_.norms.solution += of_solution;
            field_.norms.error += of_error;
            const Tetrahedron& corners = space_.parts()[p].mesh.tets[t];
            for (std::size_t i = 0; i < 4; ++i) of_part.at_vertex[corners[i]] = mean_at(nodes[i]);
        });
    }

    const ElasticProblem& problem_;
    const FeSpace& space_;
    const std::vector<double>& displacement_;
    std::size_t number_;
    std::vector<double> sums_;
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
