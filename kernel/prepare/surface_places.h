// Which edges and vertices of a surface lie on its features.
#pragma once

#include <vector>

#include "core/types.h"
#include "surface/surface.h"

namespace kerf {

/// An edge of a surface, and what meets there.
struct PlacedEdge {
    UndirectedEdge ends;                ///< keys of vertices
    std::vector<std::int32_t> patches;  ///< of its facets, ascending
    bool is_border = false;             ///< of patches, or of more than two facets
    bool is_sharp = false;              ///< its facets meet at an angle of more than 30 degrees, or it is a border

    bool operator==(const PlacedEdge&) const = default;
};

/// The vertices of a surface by their keys, and its edges, each once, ascending. Vertices of equal keys are one. Of the
/// facets of a complex (Complex::arrays()). O(n log n).
struct PlacedSurface {
    std::vector<Vec3> points;
    std::vector<Triangle> facets;     ///< by keys
    std::vector<std::int32_t> patch;  ///< of the facets
    std::vector<PlacedEdge> edges;

    explicit PlacedSurface(const SurfaceArrays& arrays);
};

}  // namespace kerf
