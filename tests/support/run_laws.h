// The laws of a finished run, checked from its files and the input alone: nothing of the run's own bookkeeping is used.
#pragma once

#include <string>
#include <vector>

#include "files/part/vtu_reader.h"
#include "surface/complex/complex.h"

namespace kerf::test {

/// The part files of a run folder, ascending by leaf number.
std::vector<Part> read_parts(const std::string& folder);

/// The surfaces of the parts of a run that stopped at them, as meshes without tetrahedra; ascending by leaf number.
std::vector<Part> read_part_surfaces(const std::string& folder);

/// The laws that the parts break, each with a count; empty if all hold.
///
/// Volumes add up to the enclosed one; every facet of `input` is a boundary face of exactly one part, with its
/// vertices, orientation and patch; interface faces lie once on each side, turned round, and each names the other's
/// part; the boundary of the tetrahedra is what the file says; all tetrahedra are positive; GlobalVertexId is dense,
/// input vertices keep their numbers, and equal numbers mean equal coordinates, bit for bit, and the reverse.
std::string broken_laws(const std::vector<Part>& parts, const SurfaceArrays& input);

/// The same for several regions: volumes add up in each of them, every side of a facet is a boundary face of exactly
/// one part of the region that lies there, and no part has cells of two.
std::string broken_laws(const std::vector<Part>& parts, const Complex& input);

/// What Part::shared and Part::shared_edges say wrongly: of every vertex, and of every edge of a tetrahedron, that
/// several parts have, each of them names all. Empty if all is right.
std::string broken_sharing(const PartSource& parts);

/// What is wrong with the nodes on edges of parts of order 2: numbers follow those of vertices, dense, one for each
/// edge of the mesh and one edge for each number, with the same point in all parts; a straight edge has its middle.
/// Empty if all is right. `curved`: nodes may lie elsewhere.
std::string broken_edge_nodes(const PartSource& parts, bool curved = false);

}  // namespace kerf::test
