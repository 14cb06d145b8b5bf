// From displacements to stresses, reactions, and how wrong they are.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/elastic_problem.h"

namespace kerf {

/// Stresses of a part: of its elements, and averages at its vertices.
struct PartStress {
    std::vector<SymmetricTensor> of_tet;        ///< #T; the mean over the tetrahedron
    std::vector<SymmetricTensor> at_vertex;     ///< #V; averages of the elements around
    std::vector<double> error;                  ///< #T; estimate of the error in the energy norm
    double energy = 0;                          ///< of the strain, of the whole part
    std::vector<SymmetricTensor> at_edge = {};  ///< of order 2, where Part::edge_nodes are: at each
};

/// Norms of the whole mesh.
struct EnergyNorms {
    double solution = 0;  ///< square root of the integral of stress times strain
    double error = 0;     ///< the estimate
    /// The estimated error beside the norm of the true solution, as far as that is known; in [0, 1].
    double relative() const;
};

struct StressField {
    std::vector<PartStress> parts;  ///< of this rank
    EnergyNorms norms;
};

/// Stresses at nodes are averages of the cells around, by their volumes. The error is what the cells' own differ from
/// others that are nearer to the truth (Zienkiewicz and Zhu 1987): from these averages for order 1, from polynomials on
/// patches (solve/stress_patches.h) for order 2, where the estimate is 0.95 to 1.2 of the true error of smooth fields.
/// The polynomials do not become the stresses: where the surface has kinks they are further off. A node between two
/// materials has a stress in each; a tetrahedron takes that of its own, and what a part says of a vertex is that of
/// one of its cells. `number`: of the case, whose temperatures leave no stress where nothing is held. Collective; O(n),
/// however many materials there are.
StressField recover_stress(const ElasticProblem& problem, const std::vector<double>& displacement,
                           std::size_t number = 0);

/// What supports and springs do to the body, by region: internal forces of its cells at what each of them holds, less
/// the loads of the case there. Sums over all ranks. A node that two supports hold in the same direction counts for the
/// first one. Collective; O(n).
HeldForces reactions(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number = 0);

}  // namespace kerf
