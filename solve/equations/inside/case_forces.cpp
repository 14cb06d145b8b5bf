// Each load adds forces at nodes, on the cells of a part. A force at a node that is held is kept twice: on the right
// side, and in HeldForces by support and region, since reactions are internal forces less the loads at the same place
// (reactions(), solve/equations/stress.h). Inertia relief then balances the sum of all loads. Forces of temperatures
// come last and are no load: they go to the right side alone, and supports feel them by the stresses. Ranks have
// shares: each adds the forces on cells of its own parts, and a force at a vertex is taken by the rank that owns the
// vertex, once.
#include "solve/equations/inside/case_forces.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/core/error.h"
#include "solve/equations/inside/body_forces.h"
#include "solve/equations/inside/place_materials.h"

namespace kerf {

namespace {

template <class Names, class Name>
bool is_among(const Names& names, const Name& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

// Adds a force on cells of the part `p`.
void CaseForces::add_force(std::size_t p, std::int32_t node, const Vec3& force) {
    Eigen::Map<Vec3>(&current().forces[3 * node]) += force;
    problem_.share_among_holders(node, force, [&](std::int32_t support, const Vec3& share) {
        current().held_forces.add(support, space_.region_of(p), share, space_.points()[node]);
    });
}

// Adds a force at a vertex, on the rank that owns it: to the first part there that has it.
void CaseForces::add_force_at(std::int64_t row, const Vec3& force) {
    const std::int64_t own = row - space_.first_row();
    if (own < 0 || own >= space_.owned_count()) return;
    for (std::size_t p = 0; p < space_.parts().size(); ++p)
        if (is_among(space_.nodes_of_parts()[p].of_vertex, own)) return add_force(p, own, force);
}

void CaseForces::add_load(const Load& load) {
    const std::string who = fmt::format("Load '{}'", load.name);
    if (load.where.point) return add_force_at(selector_.nearest_vertex(*load.where.point, who), *load.force);
    const std::vector<SurfaceFacet> facets = selector_.facets(load.where, who);
    double area = 0;
    for (const SurfaceFacet& facet : facets) area += facet.area;
    area = space_.ranks().all_reduce(area, Reduction::sum);
    for (const SurfaceFacet& facet : facets) {
        const FacetElement element = space_.facet_element(facet.part, facet.facet);
        const FacetElement::Forces forces =
            load.pressure ? element.forces_of_pressure(*load.pressure)
                          : element.forces_of_traction(load.traction ? *load.traction : Vec3(*load.force / area));
        const auto nodes = space_.nodes_of_facet(facet.part, facet.facet);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i] >= 0) add_force(facet.part, nodes[i], forces[i]);
    }
}

void CaseForces::require_density(const char* what) const {
    if (std::all_of(problem_.materials.begin(), problem_.materials.end(),
                    [](const Material& material) { return material.density == 0; }))
        throw Error(ErrorCode::usage,
                    fmt::format("There is {}, but no material has a density. Add density to [material.{}].", what,
                                problem_.materials.front().name));
}

void CaseForces::add_gravity(const Vec3& acceleration) {
    for_all_tets(space_, [&](std::size_t p, std::size_t t) {
        const TetElement::Shapes volumes = space_.element(p, t).node_volumes();
        const auto nodes = space_.nodes_of(p, t);
        const Vec3 density = problem_.material(p, t).density * acceleration;
        for (int n = 0; n < element_nodes(space_.order()); ++n) add_force(p, nodes[n], volumes[n] * density);
    });
}

void CaseForces::add_rotation(const Rotation& rotation) {
    require_density("a rotation");
    const Vec3& axis = rotation.axis.direction;
    for_all_tets(space_, [&](std::size_t p, std::size_t t) {
        const double factor = problem_.material(p, t).density * rotation.omega * rotation.omega;
        const NodalForces forces = body_forces(space_.element(p, t), [&](const Vec3& place) -> Vec3 {
            const Vec3 arm = place - rotation.axis.point;
            return factor * (arm - axis.dot(arm) * axis);
        });
        const auto nodes = space_.nodes_of(p, t);
        for (int n = 0; n < element_nodes(space_.order()); ++n) add_force(p, nodes[n], forces[n]);
    });
}

void CaseForces::add_temperature(const Temperature& temperature) {
    for (const std::string& name : temperature.materials)
        if (std::none_of(wanted_.materials.begin(), wanted_.materials.end(),
                         [&](const MaterialUse& use) { return use.material.name == name; }))
            throw Error(ErrorCode::usage, fmt::format("A temperature names the material '{}', which the case does not "
                                                      "have.",
                                                      name));
    std::vector<std::int32_t> regions;
    for (const std::string& name : temperature.regions)
        regions.push_back(region_called(outline_, name, "A temperature"));
    std::vector<double>& thermal = current().thermal;
    thermal.resize(problem_.materials.size(), 0);
    for (std::size_t m = 0; m < thermal.size(); ++m) {
        const Material& material = problem_.materials[m];
        if (!temperature.materials.empty() && !is_among(temperature.materials, material.name)) continue;
        if (!regions.empty() && !is_among(regions, region_of_material_[m])) continue;
        if (material.expansion == 0)
            throw Error(ErrorCode::usage,
                        fmt::format("Material '{}' has a temperature, but no expansion. Add expansion "
                                    "to [material.{}], or name the materials of [[temperature]].",
                                    material.name, material.name));
        thermal[m] += material.expansion * temperature.difference;
    }
}

// Adds the forces of temperatures. They stretch the body and are no load: supports feel them by the stresses.
void CaseForces::add_thermal_forces() {
    if (current().thermal.empty()) return;
    std::vector<double>& forces = current().forces;
    for_all_tets(space_, [&](std::size_t p, std::size_t t) {
        const double strain = problem_.thermal_strain(problem_.cases.size() - 1, p, t);
        if (strain == 0) return;
        const NodalForces of_element = thermal_forces(space_.element(p, t), problem_.material(p, t), strain);
        const auto nodes = space_.nodes_of(p, t);
        for (int n = 0; n < element_nodes(space_.order()); ++n)
            Eigen::Map<Vec3>(&forces[3 * nodes[n]]) += of_element[n];
    });
}

void CaseForces::add_case(const std::string& name) {
    ProblemCase& added = problem_.cases.emplace_back();
    added.name = name;
    added.forces.assign(3 * space_.node_count(), 0);
    added.held_forces = HeldForces(problem_.places, space_.region_count());
    for (const Load& load : wanted_.loads)
        if (is_in_case(load.load_case, name)) add_load(load);
    Vec3 gravity = Vec3::Zero();
    for (const Gravity& one : wanted_.gravity)
        if (is_in_case(one.load_case, name)) gravity += one.acceleration;
    if (gravity.squaredNorm() > 0) add_gravity(gravity);
    for (const Rotation& rotation : wanted_.rotations)
        if (is_in_case(rotation.load_case, name)) add_rotation(rotation);
    for (const Temperature& temperature : wanted_.temperatures)
        if (is_in_case(temperature.load_case, name)) add_temperature(temperature);
    for (const double force : current().forces) current().load_sum += std::abs(force);
    if (problem_.relief.is_needed())
        problem_.relief.balance(problem_, current(), [this](std::size_t p, std::int32_t node, const Vec3& force) {
            add_force(p, node, force);
        });
    add_thermal_forces();
}

void CaseForces::add_combination(const Combination& combination) {
    ProblemCase sum;
    sum.name = combination.name;
    sum.forces.assign(3 * space_.node_count(), 0);
    sum.held_forces = HeldForces(problem_.places, space_.region_count());
    for (const auto& [name, factor] : combination.factors) {
        const auto of = std::find_if(problem_.cases.begin(), problem_.cases.end(),
                                     [&, n = name](const ProblemCase& one) { return one.name == n; });
        sum.factors.emplace_back(of - problem_.cases.begin(), factor);
        for (std::size_t dof = 0; dof < sum.forces.size(); ++dof) sum.forces[dof] += factor * of->forces[dof];
        sum.held_forces.add(factor, of->held_forces);
        sum.load_sum += std::abs(factor) * of->load_sum;
        sum.inertia += factor * of->inertia;
        if (!of->thermal.empty()) sum.thermal.resize(of->thermal.size(), 0);
        for (std::size_t m = 0; m < of->thermal.size(); ++m) sum.thermal[m] += factor * of->thermal[m];
        sum.relieved.resize(of->relieved.size());
        for (std::size_t b = 0; b < of->relieved.size(); ++b) {
            sum.relieved[b].centre = of->relieved[b].centre;
            sum.relieved[b].acceleration += factor * of->relieved[b].acceleration;
            sum.relieved[b].angular_acceleration += factor * of->relieved[b].angular_acceleration;
        }
    }
    problem_.cases.push_back(std::move(sum));
}

}  // namespace kerf
