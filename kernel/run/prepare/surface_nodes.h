// Nodes on the edges of a surface, for cells of second order.
#pragma once

#include <cstdint>
#include <vector>

#include "base/core/types.h"
#include "run/prepare/input.h"
#include "run/request/run_request.h"

namespace kerf {

/// The nodes on those edges of a surface that are not straight. A function of the surface alone, before it is cut: both
/// sides of an interface or wall, and all ranks, have the same.
struct SurfaceNodes {
    std::vector<UndirectedEdge> edges;  ///< ascending; vertices of the surface by their keys, which are their global
                                        ///< numbers (run/prepare/numbering.h)
    std::vector<Vec3> points;           ///< the node of each edge
    std::int64_t surface_edges = 0;     ///< number of all edges, straight ones included

    /// Returns the node of an edge, null if it is in the middle. O(log).
    const Vec3* find(const UndirectedEdge& edge) const;
};

/// Returns the surface as it was read, where remeshing hides it: needed for nodes if the input is of triangles. Empty
/// if the options ask for no nodes.
SurfaceArrays surface_behind(const Input& input, const RunRequest& options);

/// Returns the nodes for the surface of `input`, ready to be cut, or none where the options or the input ask for
/// straight edges alone, with a note in Input::notes where that may surprise.
///
/// For a CAD file, vertices are moved onto its faces first, those on borders of patches onto the curves that their
/// faces share, while corners stay; nodes lie there, too, nearest to the middle of the edge. The surface stays closed
/// and free of intersections, and no facet turns by more than 60 degrees: vertices that would break that, or move by
/// more than 0.3 of an edge, stay. For a remeshed file of triangles, nodes lie on the facets of the same patch of the
/// file, those of borders and sharp edges on these edges of the file, and vertices stay; facets that were kept are
/// straight. `behind`: from surface_behind(). A node that would be further from the middle than a tenth of the edge is
/// left in the middle, and so is that of an edge that ends in a vertex beside its face; a note counts both.
///
/// Throws as project_on_cad_file() does. Deterministic. O(n log n), and the time of kerf-cad: that for reading the file
/// again, and some microseconds an edge.
SurfaceNodes make_surface_nodes(Input& input, const SurfaceArrays& behind, const RunRequest& options);

}  // namespace kerf
