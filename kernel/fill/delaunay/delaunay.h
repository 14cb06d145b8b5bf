// The Delaunay triangulation of many points at once.
#pragma once

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf {

struct Delaunay {
    /// The triangulation. Vertices have the numbers of their points. Without cells if all points lie in one plane.
    SpatialTriangulation triangulation;
    /// The smallest number of a point in the place of each point. All others there have no cells.
    std::vector<std::int32_t> representative;
};

/// Returns the Delaunay triangulation of the points. Its cells depend on the points alone, not on their order, and ties
/// are decided as in_sphere() does; the order of the cells depends on that of the points. Coordinates must be finite
/// and below 1e100. Throws Error(memory) where there are too many, see SpatialTriangulation::insert(). 3 to 4 us a
/// point where most lie in space, three times as many on an exact lattice; memory of the result and 33 bytes a point.
Delaunay delaunay(std::vector<Vec3> points);

}  // namespace kerf
