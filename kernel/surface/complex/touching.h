// Closed surfaces that touch themselves at vertices or along edges.
#pragma once

#include <vector>

#include "surface/complex/surface.h"

namespace kerf {

/// A closed surface in which every fan of facets has vertices of its own. Copies have the key of their original.
struct SeparatedSurface {
    SurfaceArrays arrays;
    std::vector<std::int32_t> partner;   ///< 3 #F, as taken by Surface::build(): two edges may have the same ends
    std::vector<std::int32_t> original;  ///< #V; the number of each vertex before; empty if the surface does not touch
                                         ///< itself

    bool touches() const { return !original.empty(); }
};

/// Takes a surface apart where it touches itself. The arrays must be well-formed, with normals that point out of the
/// body. Exact signs pair the facets at an edge of more than two by the wedge of the body between them; facets around a
/// vertex that are connected by such pairs are a fan. The fan with the smallest facet keeps the vertex, each other one
/// gets a copy, numbered behind all vertices in the order of vertices and smallest facets. Facets keep their numbers
/// and their corners. Two edges may have the same two ends then, if the facets of both are in one fan at each of these;
/// only their partners tell such edges from each other.
///
/// Arrays that do not touch themselves come back as they are, and so do arrays that have been separated before, with
/// their partners. Throws Error(internal) for facets that do not pair: some lie on one another, or do not close. O(#F),
/// and O(k log k) at an edge of k facets.
SeparatedSurface separate_touching(SurfaceArrays arrays);

/// Returns the surface of separated arrays. Throws Error(internal) if they are no manifold.
Surface to_surface(SeparatedSurface separated);

/// Returns to_surface(separate_touching(arrays)), as fast as Surface(arrays) if that is a manifold already.
Surface separated_surface(const SurfaceArrays& arrays);

/// Joins vertices of equal keys: the first of them stays, and later vertices move up. Arrays whose keys all differ come
/// back as they are. O(#V log #V).
SurfaceArrays joined_by_key(SurfaceArrays arrays);

/// Returns for each vertex whether others have its key, as copies do; empty if all keys differ. O(#V) if the indices of
/// keys are dense, as in an input and in cuts, else O(#V log #V).
Array<Vertex, char> copied_vertices(const Surface& surface);

/// Whether the surface touches itself along an edge at the vertex, which must have facets: two of its edges lead to
/// vertices of the same key. O(degree log degree).
bool has_touching_edge(const Surface& surface, Vertex vertex);

}  // namespace kerf
