// Better shaped triangles on the same surface, by moving vertices along it; the topology stays.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

struct OptimisationOptions {
    double feature_angle_deg = 30;  ///< between the normals of two facets: their edge is kept if it is larger
    double spring = 0.03;           ///< weight of the spring energy, dimensionless, > 0
    int sweeps = 10;                ///< most sweeps; fewer if nothing moves any more
    double tolerance_rel = 0.05;    ///< largest distance from the original surface, per edge length at the vertex
    double max_turn_deg = 10;       ///< largest turn of a facet against its original normal
};

/// Moves vertices so that the distance energy plus the spring energy of Hoppe et al. (1993, hoppe1993) falls: the
/// squared distances of sample points of the original surface (its vertices and facet centroids) to the current one,
/// plus `spring` times the squared lengths of the edges. A sample is measured to the facet where it was last found
/// closest, which bounds its distance from above; the energy never ends above that of the input. Returns #V positions;
/// number of vertices and facets stay.
///
/// Vertices that keep their place bit for bit: those with fixed[v] != 0 (#V, or empty), those without facets, and the
/// ends of every edge that has not exactly two consistently oriented facets, that divides two patches (#F) or two
/// facets at more than the feature angle. A single move is made only if the energy falls, no facet turns too far, the
/// vertex keeps within the tolerance, and the smallest angle of the facets around it gets no smaller; so the smallest
/// angle of the surface never falls. Vertices of a plane stay in it. Where surfaces nearly touch, self-intersections
/// are possible, as the tolerance is relative to the edges: the caller proves their absence.
///
/// Facets must have three different corners; they need not be closed. Independent of time and threads.
/// O(#V + #F) per sweep, less once vertices have come to rest; O(#F log #F) before.
std::vector<Vec3> optimise_nodes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const std::vector<std::int32_t>& patch, const std::vector<char>& fixed,
                                 const OptimisationOptions& options = {});

}  // namespace kerf
