// A surface with edges of more than two facets, taken apart into sheets.
#pragma once

#include <vector>

#include "surface/complex/surface.h"

namespace kerf {

/// The sheets of a surface. They end at seams: edges that do not have exactly two facets. Each fan of facets around a
/// vertex, from seam to seam, has a copy of the vertex, so that half-edges can be built.
struct Sheets {
    SurfaceArrays surface;               ///< copies are behind all vertices, with the key of their original
    std::vector<std::int32_t> partner;   ///< 3 #F; the corner on the other side of an edge, -1 at a seam
    std::vector<std::int32_t> original;  ///< #V; the number of each vertex before
    std::size_t vertices_before = 0;

    /// Returns the ends of the edge at a corner, with their numbers before.
    UndirectedEdge edge_before(std::int32_t corner) const;
    /// Returns the facets with the numbers of vertices before.
    std::vector<Triangle> facets_before() const;
};

/// Gives each fan of facets around a vertex, from edge to edge without a partner, a vertex of its own. The fan with the
/// smallest corner keeps the vertex. Returns for each vertex, the new ones behind all others, that which it was.
/// `partner` as edge_partners() gives it. O(#V + #F).
std::vector<std::int32_t> separate_fans(std::size_t vertices, const std::vector<std::int32_t>& partner,
                                        std::vector<Triangle>& facets);

/// Takes a surface apart. The fan with the smallest corner keeps the vertex. Facets at an edge of two must have it in
/// opposite directions. A closed manifold comes back as it is. O(#F).
Sheets take_apart(const SurfaceArrays& surface);

}  // namespace kerf
