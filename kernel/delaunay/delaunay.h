// The Delaunay triangulation of many points at once.
#pragma once

#include "delaunay/triangulation.h"

namespace kerf {

struct Delaunay {
    /// Vertices have the numbers of their points. Without cells if all points lie in one plane.
    Triangulation triangulation;
    /// Of each point: the smallest number of those that lie where it lies. The others have no cells.
    std::vector<std::int32_t> representative;
};

/// Which cells there are depends on the points alone, not on their order, and ties are decided as in_sphere() does; the
/// order of the cells depends on that of the points. At most 70 million points, or Error (memory): their cells are numbered
/// by 28 bits. 3 us a point where most lie in space; memory of the result and 32 bytes a point.
Delaunay delaunay(std::vector<Vec3> points);

}  // namespace kerf
