// Edges and vertices of a surface, and the features that they lie on.
#pragma once

#include <vector>

#include "base/core/types.h"
#include "surface/complex/surface.h"

namespace kerf {

/// An edge of a surface, with the patches and the angle that meet there.
struct PlacedEdge {
    UndirectedEdge ends;                ///< keys of vertices
    std::vector<std::int32_t> patches;  ///< patches of its facets, ascending
    bool is_border = false;             ///< whether it bounds patches, or has other than two facets
    bool is_sharp = false;  ///< whether its facets meet at an angle of more than 30 degrees, or it is a border

    bool operator==(const PlacedEdge&) const = default;
};

/// The vertices of a surface by their keys, and its edges, each once, ascending. Vertices of equal keys are one. Made
/// of the facets of a complex (Complex::arrays()). O(n log n).
struct PlacedSurface {
    std::vector<Vec3> points;
    std::vector<Triangle> facets;     ///< corners by keys
    std::vector<std::int32_t> patch;  ///< patch of each facet
    std::vector<PlacedEdge> edges;

    explicit PlacedSurface(const SurfaceArrays& arrays);
};

}  // namespace kerf
