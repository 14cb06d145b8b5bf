// Facets of which more than two may meet in an edge, taken apart into sheets.
#pragma once

#include <vector>

#include "surface/surface.h"

namespace kerf {

/// Sheets end at seams: edges that have not exactly two facets. Each fan of facets around a vertex, from seam to seam,
/// has a copy of it, so that half-edges can be built.
struct Sheets {
    SurfaceArrays surface;               ///< copies behind all vertices, with the key of theirs
    std::vector<std::int32_t> partner;   ///< 3 #F; the corner on the other side of an edge, -1 at a seam
    std::vector<std::int32_t> original;  ///< #V; number before
    std::size_t vertices_before = 0;

    /// The ends of the edge at a corner, as they were numbered before.
    UndirectedEdge edge_before(std::int32_t corner) const;
    /// The facets as they were.
    std::vector<Triangle> facets_before() const;
};

/// The fan with the smallest corner keeps the vertex. Facets that meet in an edge of two must have it in opposite
/// directions. A closed manifold comes back as it is. O(#F).
Sheets take_apart(const SurfaceArrays& surface);

}  // namespace kerf
