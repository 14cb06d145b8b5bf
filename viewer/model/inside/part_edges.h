// The nodes on the edges of a part of second order, in the form in which the viewer has them.
#pragma once

#include "files/part/part.h"
#include "viewer/model/document.h"

namespace kerf::view {

/// Adds the nodes on the edges of a part's tetrahedra, or of the triangles of its surface, whose vertices come first in
/// the part; adds none for a part of first order. O(n log n) in the edges at a vertex.
void add_edges(const Part& part, PartCells& cells);
void add_edges(const Part& part, NodeSurface& surface);

}  // namespace kerf::view
