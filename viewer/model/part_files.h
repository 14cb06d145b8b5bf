// What the files of a run's parts hold, as the viewer has it. All functions read; nothing is kept. Those that
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

/// FOLDER/parts/part_0008.vtu, or part_0008.part where that is not written yet, and part_0008.surface.vtu there.
std::string part_file_of(const std::string& folder, NodeId part);
std::string part_surface_file_of(const std::string& folder, NodeId part);

/// Adds the nodes on the edges of a part's surface: reads the part. Throws Error(io).
void add_edge_nodes(const std::string& folder, NodeId part, NodeSurface& surface);

/// The node at whose cut two parts came apart.
NodeId common_ancestor(NodeId a, NodeId b);

/// The closed surface of a part, without nodes on edges. Throws Error(io). `patch_names`, unless null, receives those
/// of the file.
NodeSurface read_part_surface(const std::string& folder, NodeId part, std::vector<std::string>* patch_names = nullptr);

/// A part below a node, and its surface if that is at hand.
using PartBelow = std::pair<NodeId, std::shared_ptr<const NodeSurface>>;

/// The surface of a node: those of the parts below it without the interfaces between them, vertices merged by number;
/// facets in the order of the parts. Reads what is not at hand. Throws Error(io).
NodeSurface join_part_surfaces(const std::string& folder, NodeId node, const std::vector<PartBelow>& parts);

/// Where a part is, and what its files do not tell.
struct PartSource {
    std::string folder;
    NodeId part = 1;
    std::int64_t core_tets = 0;  ///< Filling::core_tets
    std::string nodes = {};      ///< the folder whose files have nodes on edges, too: it, or a solution. Empty: none
};

/// The tetrahedra of a part. Throws Error(io).
PartCells read_part_cells(const PartSource& source);

/// The array of the part files with a measure; nullptr if it has to be computed from the cells.
const char* stored_array(ColorBy color);

/// A value for every cell, computed: kinds (CellOrigin), `volume`, `edge_length` and the measures that files hold.
std::vector<float> values_of_cells(const PartCells& cells, ColorBy color);
/// As the file has them, or computed from the cells, which are read unless they are given. Throws Error(io).
std::vector<float> read_values_of_cells(const PartSource& source, ColorBy color, const PartCells* cells);
/// The same for the cells behind the facets of the part's surface; NaN where there is none.
std::vector<float> read_values_at_facets(const PartSource& source, ColorBy color, const PartCells* cells);

/// The `count` worst cells of the parts, worst first; of equal ones that of the smaller part, then the smaller cell.
/// Returns nothing if `is_stale` becomes true, which is asked before each part. Throws Error(io).
std::vector<WorstCell> find_worst_cells(const std::string& folder, const std::vector<NodeId>& parts, ColorBy color,
                                        std::size_t count, const std::function<bool()>& is_stale);

/// The bounding box of the surfaces of parts. Throws Error(io).
Eigen::AlignedBox3d box_of_parts(const std::string& folder, const std::vector<NodeId>& parts);

}  // namespace kerf::view
