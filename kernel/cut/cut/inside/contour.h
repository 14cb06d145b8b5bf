// The step from labels of facets to closed contours in which an interface can be spanned.
#pragma once

#include <vector>

#include "cut/cut/inside/band.h"

namespace kerf {

/// Relabels facets of the band until the boundary between the labels has no ears (facets with two contour edges), no
/// small islands, no vertex with more than two contour edges and no chord (a surface edge off the contour that joins
/// two contour vertices) with a small pocket. Facets outside of the band keep their label; whole shells are no islands.
/// Defects that cannot be mended within a bounded number of passes stay, and are found by later checks. `stages`, if
/// given, receives closed_loops and multiple_paths_removed. O(band) per pass.
void clean_labels(const Surface& surface, const Band& band, Array<Facet, Side>& side, ContourStages* stages);

/// Returns the edges between the labels, oriented with the half below on their left, ascending by facet.
std::vector<SurfaceEdge> contour_edges(const Surface& surface, const Band& band, const Array<Facet, Side>& side);

/// The closed loops of contour edges, or the vertices at which there are none: more than two contour edges meet there,
/// or the surface touches itself, so that halves could not be told from each other by their vertices.
struct ContourLoops {
    std::vector<std::vector<Vertex>> loops;  ///< each starts at the edge that comes first in `contour_edges`
    std::vector<Vertex> pinched;             ///< if not empty, `loops` is meaningless
};
/// Traces the loops of contour edges. `copied`: copied_vertices() of the surface (surface/complex/touching.h).
ContourLoops trace_loops(const Surface& surface, const std::vector<SurfaceEdge>& edges,
                         const Array<Vertex, char>& copied = {});

}  // namespace kerf
