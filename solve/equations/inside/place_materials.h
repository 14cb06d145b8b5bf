// The material of each tetrahedron.
#pragma once

#include "solve/equations/elastic_problem.h"

namespace kerf {

/// Fills ElasticProblem::materials and material_of_tet. For each region whose temperature a case names, the materials
/// in it are there once more, for this region alone. Returns for each material the region in which alone it is, or -1.
/// Throws Error(usage), on all ranks alike, for names that the mesh does not have and for a cell without a material or
/// with two. Collective.
std::vector<std::int32_t> place_materials(ElasticProblem& problem, const MeshOutline& outline,
                                          const ElasticCase& wanted, const SurfaceSelector& selector,
                                          const SpaceBodies& bodies);

/// Returns the number of a region. Throws Error(usage), beginning with `who`, for a name that the mesh does not have.
std::size_t region_called(const MeshOutline& outline, const std::string& name, const std::string& who);

}  // namespace kerf
