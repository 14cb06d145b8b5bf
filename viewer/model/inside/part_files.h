// Reads the files of a run's parts into the forms that the viewer has; nothing is kept between calls. Functions that
// throw Error(io) throw Error(verification) for a file that is not as its finished run has left it (checked_files.h).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Returns FOLDER/parts/part_0008.vtu, or part_0008.part where that is not written yet.
std::string part_file_of(const std::string& folder, NodeId part);

/// Adds the nodes on the edges of a part's surface, for which the part is read. Throws Error(io).
void add_edge_nodes(const std::string& folder, NodeId part, NodeSurface& surface);

/// Returns the node at whose cut two parts came apart.
NodeId common_ancestor(NodeId a, NodeId b);

/// Reads the closed surface of a part, without nodes on edges. `patch_names`, unless null, receives the names of
/// patches in the file. Throws Error(io).
NodeSurface read_part_surface(const std::string& folder, NodeId part, std::vector<std::string>* patch_names = nullptr);

/// A part below a node, and its surface if that is at hand.
using PartBelow = std::pair<NodeId, std::shared_ptr<const NodeSurface>>;

/// Returns the surface of a node: the surfaces of the parts below it, joined without the interfaces between them.
/// Vertices are merged by number, and facets are in the order of the parts. Reads surfaces that are not at hand. Throws
/// Error(io).
NodeSurface join_part_surfaces(const std::string& folder, NodeId node, const std::vector<PartBelow>& parts);

/// The place of a part's files, and facts of the part that they do not tell.
struct PartSource {
    std::string folder;
    NodeId part = root_node;
    std::int64_t core_tets = 0;  ///< Filling::core_tets
    std::string nodes = {};      ///< the folder whose files have nodes on edges: `folder`, or a solution. Empty: none
};

/// Reads the tetrahedra of a part. Throws Error(io).
PartCells read_part_cells(const PartSource& source);

/// Returns the name of the array of the part files with a measure; nullptr if it has to be computed from the cells.
const char* stored_array(ColorBy color);

/// Computes a value for every cell: `kind`, `origin` (CellOrigin), `volume`, `edge_length` or a measure that files
/// hold.
std::vector<float> values_of_cells(const PartCells& cells, ColorBy color);
/// Returns a value for every cell as the file has it, or computed from the cells, which are read unless they are given
/// (`cells` may be null). Throws Error(io).
std::vector<float> read_values_of_cells(const PartSource& source, ColorBy color, const PartCells* cells);
/// Returns such a value for the cell behind every facet of the part's surface; NaN where there is none. Throws
/// Error(io).
std::vector<float> read_values_at_facets(const PartSource& source, ColorBy color, const PartCells* cells);

/// Returns the `count` worst cells of the parts, worst first; of equal cells the one of the smaller part, then the one
/// of the smaller number comes first. Returns none if `is_stale` becomes true, which is asked before each part. Throws
/// Error(io).
std::vector<WorstCell> find_worst_cells(const std::string& folder, const std::vector<NodeId>& parts, ColorBy color,
                                        std::size_t count, const std::function<bool()>& is_stale);

/// Returns the bounding box of the surfaces of parts. Throws Error(io).
Eigen::AlignedBox3d box_of_parts(const std::string& folder, const std::vector<NodeId>& parts);

}  // namespace kerf::view
