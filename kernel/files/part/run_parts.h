// The parts of a finished run.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "files/io/listed_files.h"
#include "files/part/edge_numbers.h"
#include "files/part/part.h"
#include "files/part/part_ranges.h"
#include "files/part/shared_edges.h"
#include "files/part/shared_vertices.h"

namespace kerf {

/// The parts in a run folder; with a solution they have its values and its order. Memory: the vertices on interfaces,
/// of a run of order 2 without VTU files the nodes that are not in the middle of their edges, and the parts that are
/// loaded.
class RunParts : public PartSource {
 public:
    /// Reads report.json and the surfaces of the parts. Throws Error(io) for a folder that is no finished run, or one
    /// with parts that were not meshed, naming it and the way out. Each file is compared with its hash before it is
    /// read, and its numbers with each other: a file that the run has not left like this throws Error(verification),
    /// from here or from a load. `solution`: the folder of a solution on this run (files/part/solution_parts.h), whose
    /// values the parts have that are loaded with everything.
    explicit RunParts(std::string folder, std::string solution = "");

    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override;
    Part load_only(PartIndex index, PartContent content) const override;

 private:
    RunParts(std::string folder, std::string solution, const nlohmann::json& report);
    void number_edges();
    /// Returns the files with the parts: a solution holds its parts, too, of the order that it was found with.
    const ListedFiles& files_of_parts() const { return solution_files_ ? *solution_files_ : files_; }
    /// Returns the path of a verified file, as all that are read.
    std::string part_file(PartIndex index) const;
    std::string surface_file(PartIndex index) const;
    Part surface(PartIndex index, PartContent content = PartContent::all) const;
    bool is_stored(PartIndex index) const;
    PartStanding standing(PartIndex index) const;

    ListedFiles files_;
    std::optional<ListedFiles> solution_files_;
    MeshOutline outline_;
    std::int64_t boundary_vertices_ = 0;
    Array<PartIndex, std::int64_t> first_interior_ids_;
    SharedVertices shared_;
    SharedEdges shared_edges_;
    EdgeNumbers edge_numbers_;  // of a run of order 2
    CurvedNodes curved_nodes_;  // of a run of order 2 with stored parts
};

/// Returns the path of a part of a finished run: FOLDER/parts/part_0008.vtu, or part_0008.part of a run without that
/// format.
std::string path_of_part(const std::string& folder, NodeId id);
/// Returns the same file as a path in the folder.
std::string path_of_part_in(const std::string& folder, NodeId id);

/// Reads this content of a part of a run, with the tetrahedra behind its facets, but without its shared vertices.
/// `first_interior_id`: global number of the first interior vertex of a stored part; VTU files hold all numbers, also
/// those of nodes on edges, which stored parts do not have. Throws Error(io).
Part load_part(const std::string& folder, NodeId id, std::int64_t first_interior_id,
               PartContent content = PartContent::all);
/// Reads a part as load_part(), from the file at this path.
Part load_part_file(const std::string& path, std::int64_t first_interior_id, PartContent content = PartContent::all);

}  // namespace kerf
