// Stresses and reactions of displacements, and estimates of their error.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/equations/elastic_problem.h"

namespace kerf {

/// The stresses of a part: of its elements, and averages at its vertices.
struct PartStress {
    std::vector<SymmetricTensor> of_tet;        ///< #T; the mean over the tetrahedron
    std::vector<SymmetricTensor> at_vertex;     ///< #V; averages of the elements around
    std::vector<double> error;                  ///< #T; estimate of the error in the energy norm
    double energy = 0;                          ///< strain energy of the whole part
    std::vector<SymmetricTensor> at_edge = {};  ///< for order 2: at each node of Part::edge_nodes
};

/// Energy norms over the whole mesh.
struct EnergyNorms {
    double solution = 0;  ///< square root of the integral of stress times strain
    double error = 0;     ///< estimated norm of the error
    /// Returns the estimated error beside the norm of the true solution, as far as that is known; in [0, 1].
    double relative() const;
};

struct StressField {
    std::vector<PartStress> parts;  ///< of this rank
    EnergyNorms norms;
};

/// Recovers stresses and estimates their error. Stresses at nodes are averages of the cells around, by their volumes.
/// The error is the difference of the cells' own stresses to others that are nearer to the truth (Zienkiewicz and Zhu
/// 1987, zienkiewicz1987): to these averages for order 1, to polynomials on patches
/// (solve/equations/inside/stress_patches.h) for order 2, where the estimate is 0.95 to 1.2 of the true error of smooth
/// fields. The polynomials do not become the stresses: where the surface has kinks they are further off. A node between
/// two materials has a stress in each; a tetrahedron takes that of its own, and a part has at a vertex that of one of
/// its cells. `number`: the case, whose temperatures leave no stress where nothing is held. Collective; O(n), however
/// many materials there are.
StressField recover_stress(const ElasticProblem& problem, const std::vector<double>& displacement,
                           std::size_t number = 0);

/// Returns the forces of supports and springs on the body, by region: internal forces of its cells at the degrees of
/// freedom that each of them holds, less the loads of the case there. Sums over all ranks. A node that two supports
/// hold in the same direction counts for the first one. Collective; O(n).
HeldForces reactions(const ElasticProblem& problem, const std::vector<double>& displacement, std::size_t number = 0);

}  // namespace kerf
