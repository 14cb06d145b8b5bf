// A case on a mesh: which nodes are held, what pulls at them, what the cells are made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solve/elastic_case.h"
#include "solve/fe_space.h"
#include "solve/held_forces.h"
#include "solve/space_bodies.h"
#include "solve/surface_selection.h"

namespace kerf {

/// Degrees of freedom are 3 * node + component. Arrays over local nodes hold the same for a node on every rank.
struct ElasticProblem {
    const FeSpace* space = nullptr;
    std::vector<Material> materials;
    std::vector<std::vector<std::uint8_t>> material_of_tet;  ///< of each part of this rank; empty: the first material
    std::vector<std::string> supports;                       ///< names
    std::vector<std::int32_t> support_of;                    ///< #dof: the first support that holds it, or `free`
    std::vector<double> prescribed;                          ///< #dof: displacement where it is held
    std::vector<std::string> cases;                          ///< names
    std::vector<std::vector<double>> forces;                 ///< of each case, #dof; ranks have shares, which add up
    std::vector<HeldForces> held_forces;                     ///< of each case: those at what is held, likewise

    static constexpr std::int32_t free = INT32_MAX;
    bool is_held(std::size_t dof) const { return support_of[dof] != free; }
    const Material& material(std::size_t p, std::size_t tet) const {
        return materials[material_of_tet.empty() ? 0 : material_of_tet[p][tet]];
    }
};

/// Collective. Throws Error(usage) on all ranks alike: for what the mesh does not have, for a cell without a material
/// or with two, and for a body that its supports leave free to move, naming the motion.
ElasticProblem make_problem(const FeSpace& space, const MeshOutline& outline, const ElasticCase& wanted);

/// No displacements, no forces, one material: for who sets the rest.
ElasticProblem make_free_problem(const FeSpace& space, const Material& material);

/// Throws Error(usage) naming the rigid motions of bodies that the supports do not prevent. Collective.
void require_supported(const ElasticProblem& problem, const SpaceBodies& bodies);

}  // namespace kerf
