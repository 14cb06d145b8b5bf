// Supports of a case on the nodes of a mesh.
#pragma once

#include "solve/equations/elastic_problem.h"

namespace kerf {

/// Holds the nodes of the supports: fills ElasticProblem::supports, places, support_of, prescribed and frames. The
/// normal of a node is the mean of those of its triangles, by their areas, of each patch by itself, unless patches go
/// on into each other within 20 degrees. Throws Error(usage), on all ranks alike, for selections that the mesh does not
/// have, nodes on the axis of their support, and normals that cancel. Collective; O(n) for each support.
void hold_supports(ElasticProblem& problem, const std::vector<Support>& supports, const SurfaceSelector& selector);

/// Returns the centre of the area of triangles on all ranks. Collective.
Vec3 centre_of(const FeSpace& space, const std::vector<SurfaceFacet>& facets);

}  // namespace kerf
