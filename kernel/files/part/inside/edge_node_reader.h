// Reads the nodes on edges of a part file of order 2.
#pragma once

#include "files/part/inside/part_arrays_file.h"
#include "files/part/part.h"

namespace kerf {

/// Makes the edges of a part from the tetrahedra and facets of the file, and compares the nodes of all cells with them:
/// every edge has one node, in the order of the edges.
void find_edges(PartArraysFile& file, Part& part);

/// Adds the nodes on the edges of its facets to the surface of a part, from the part's file: edges, points and global
/// numbers. Memory: that of the surface. Throws Error(io) if the file is not that of the part with this surface.
void add_edge_nodes_of_surface(const std::string& part_file, Part& surface);

}  // namespace kerf
