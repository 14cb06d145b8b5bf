// Closed surfaces that touch themselves at vertices or along edges.
#pragma once

#include <vector>

#include "surface/surface.h"

namespace kerf {

/// A closed surface of which every fan of facets has vertices of its own. Copies have the key of the vertex.
struct SeparatedSurface {
    SurfaceArrays arrays;
    std::vector<std::int32_t> partner;   ///< 3 #F, as Surface::build() takes it: edges may be double
    std::vector<std::int32_t> original;  ///< #V; number before; empty if nothing touches

    bool touches() const { return !original.empty(); }
};

/// Takes a surface apart where it touches itself. The arrays must be well-formed, with normals that point out of the
/// body. Facets at an edge of more than two are paired by the wedge of the body between them, by exact signs; facets
/// around a vertex that hang together by such pairs are a fan. The fan with the smallest facet keeps the vertex, each
/// other one gets a copy, behind all vertices, in the order of vertices and smallest facets. Facets keep their numbers
/// and corners their places. Two edges may have the same two ends then, where these have one fan each; only their
/// partners tell them from each other.
///
/// Arrays that touch nothing come back as they are. What is separated already comes back as it is, too, with its
/// partners. Throws Error(internal) for facets that do not pair: some lie on one another, or do not close. O(#F), and
/// O(k log k) at an edge of k facets.
SeparatedSurface separate_touching(SurfaceArrays arrays);

/// The surface of what has been taken apart. Throws Error(internal) if it is none.
Surface to_surface(SeparatedSurface separated);

/// to_surface(separate_touching(arrays)), as fast as Surface(arrays) where that is a manifold already.
Surface separated_surface(const SurfaceArrays& arrays);

/// Vertices of equal keys are one again: the first of them stays, and those behind move up. Arrays whose keys all
/// differ come back as they are. O(#V log #V).
SurfaceArrays joined_by_key(SurfaceArrays arrays);

/// Per vertex whether others have its key, as copies do; empty if all keys differ. O(#V) where the indices of keys are
/// dense, as those of an input and of cuts are, else O(#V log #V).
std::vector<char> copied_vertices(const Surface& surface);

/// Whether the surface touches itself along an edge at the vertex, which has facets: two of its edges lead to vertices
/// of the same key. O(degree log degree).
bool has_touching_edge(const Surface& surface, std::int32_t vertex);

}  // namespace kerf
