// The parts of a finished run.
#pragma once

#include <string>

#include "part/edge_numbers.h"
#include "part/part.h"
#include "part/shared_edges.h"
#include "part/shared_vertices.h"

namespace kerf {

/// The parts in a run folder, with values if there is a solution, whose order they have then. Memory: the vertices on
/// interfaces, of a run of order 2 without VTU files the nodes that are not in the middle of their edges, and the parts
/// that are loaded.
class RunParts : public PartSource {
 public:
    /// Reads report.json and the surfaces of the parts. Throws Error(io) for what is no finished run, or one with parts
    /// that were not meshed, naming it and the way out. `solution`: the folder of one on this run
    /// (part/solution_parts.h), whose values parts have that are loaded with everything.
    explicit RunParts(std::string folder, std::string solution = "");

    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override;
    Part load_only(PartIndex index, PartContent content) const override;

 private:
    void number_edges();
    /// The files of a solution hold its parts, too, of the order that it was found with.
    const std::string& parts_folder() const { return solution_.empty() ? folder_ : solution_; }
    std::string part_file(PartIndex index) const;
    bool is_stored(PartIndex index) const { return part_file(index).ends_with(".part"); }

    std::string folder_, solution_;
    MeshOutline outline_;
    Array<PartIndex, std::int64_t> first_interior_ids_;
    SharedVertices shared_;
    SharedEdges shared_edges_;
    EdgeNumbers edge_numbers_;  // of order 2
    CurvedNodes curved_nodes_;  // likewise, of stored parts
};

/// Where a finished run has a part: FOLDER/parts/part_0008.vtu, or part_0008.part of a run without that format.
std::string path_of_part(const std::string& folder, NodeId id);

/// What is asked for of the part in that file, with the tetrahedra behind its facets, but without its shared vertices.
/// `first_interior_id`: global number of the first interior vertex, which a VTU file says itself, and so it does for
/// the nodes on edges, which stored parts do not have. Throws Error(io).
Part load_part(const std::string& folder, NodeId id, std::int64_t first_interior_id,
               PartContent content = PartContent::all);

}  // namespace kerf
