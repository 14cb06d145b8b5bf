// Stresses at the nodes of elements of order 2 that are nearer to the truth than the elements' own.
#pragma once

#include <vector>

#include "solve/equations/inside/material_nodes.h"

namespace kerf {

/// Returns the stresses of a case at the nodes of a space of order 2, in each material by itself: one for each of
/// `numbers`. At a vertex it is the value of the polynomial of degree 2 that is nearest to the stresses of the cells
/// around, in the mean over these cells; a node on an edge has the mean of the polynomials of both ends
/// (superconvergent patch recovery: Zienkiewicz and Zhu 1992, zienkiewicz1992). Where a patch does not determine a
/// polynomial well, it has a lower degree. Ranks add up the equations of vertices that they share, and need no cells of
/// each other. Collective; O(n), 0.9 kB for each vertex.
std::vector<SymmetricTensor> fit_stresses(const ElasticProblem& problem, const std::vector<double>& displacement,
                                          std::size_t number, const MaterialNodes& numbers);

}  // namespace kerf
