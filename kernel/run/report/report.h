// The report of a run, as plain data and as report.json (schema 1).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "files/io/run_manifest.h"
#include "fill/improve/improve.h"
#include "run/prepare/cells.h"
#include "run/prepare/input.h"
#include "run/request/run_request.h"
#include "run/work/part_queue.h"

namespace kerf {

/// One part of the run: a leaf of the tree, and its outcome.
struct PartReport : PartOutcome {
    NodeId id = root_node;
    std::int32_t rank = 0;  ///< rank that meshed it; before that, the rank that cut it
    bool resumed = false;   ///< true: an interrupted run had finished it
    double load = 0;        ///< predicted work, in units of LoadModel
    FileHash job_hash = {0, 0};
    FileHash surface_hash = {0, 0};  ///< hash of the file of its surface
    double surface_volume = 0;
    double surface_volume_error = 0;                         ///< bound of its rounding (BoundedVolume)
    double sized_volume = 0;                                 ///< result of sized_volume()
    double tets_at_facets = 0;                               ///< forecast of cells at the facets that are no interface
    Eigen::AlignedBox3d box = {Vec3::Zero(), Vec3::Zero()};  ///< box around its surface
    std::int64_t surface_vertices = 0, surface_facets = 0;
    std::int64_t interface_facets = 0;  ///< number of the facets on interfaces
    std::int64_t walls_of_others = 0;  ///< number of the facets that are walls which the part on their other side lists
    RegionIndex region;
    double interface_area = 0;
    /// Interface area with that of each facet divided by the square of CutOptions::max_interface_edge() there.
    double interface_in_squared_edges = 0;
    std::vector<NodeId> neighbours;  ///< numbers of the parts behind its interfaces, ascending
    /// Number of vertices and nodes on edges of a part of order 2; known to each rank once parts are written.
    std::int64_t mesh_nodes = 0;

    template <class Archive>
    void archive(Archive& a) {
        PartOutcome::archive(a);
        a(id, rank, resumed, load, job_hash, surface_hash, surface_volume, surface_volume_error, sized_volume,
          tets_at_facets, box.min(), box.max(), surface_vertices, surface_facets, interface_facets, walls_of_others,
          region, interface_area, interface_in_squared_edges, neighbours);
    }
};

/// The laws of a whole mesh, counted (run_laws).
struct RunVerification {
    bool passed = false;
    double volume_rel_error = 0;            ///< relative difference of the sum of the parts to the enclosed volume
    double volume_rel_bound = 0;            ///< bound of that difference by rounding, found beside both sums
    std::int64_t input_faces_missing = 0;   ///< facets of the input that are no boundary face of exactly one part
    std::int64_t extra_boundary_faces = 0;  ///< boundary faces of parts that are neither input nor interface
    /// Interface triangles not once on each side, with the same keys in opposite order.
    std::int64_t unmatched_interface_faces = 0;
    std::int64_t wrong_neighbours = 0;  ///< interface triangles that do not name the part on the other side
    std::int64_t inverted_tets = 0;
    std::int64_t tets_without_volume = 0;  ///< sum of MeshLaws::tets_without_volume
    std::int64_t tets_zero_parts = 0;      ///< parts without a tetrahedron
    std::int64_t moved_vertices = 0;       ///< vertices whose coordinates differ between parts, or from the input
    std::int64_t misnumbered = 0;      ///< global numbers that are missing, or used by two interior vertices or edges
    std::int64_t changed_volumes = 0;  ///< result of count_changed_volumes()
    std::int64_t unequal_edge_nodes = 0;    ///< edges whose nodes differ between parts, for order 2
    std::int64_t invalid_curved_cells = 0;  ///< cells that are not proven to have a positive Jacobian, for order 2

    /// Returns whether the volumes agree within the bound and every count is zero.
    bool all_hold() const;
};

/// One law of a whole mesh: a count that must be zero.
struct RunLaw {
    const char* name;  ///< name in JSON
    std::int64_t RunVerification::*count;
    const char* broken;        ///< words for people, behind the count
    bool is_of_files = false;  ///< true: only files can break it, so that kerf verify alone looks
};
/// The laws that are counts, in the order in which they are told. A new one is a count of RunVerification and a row
/// here; reports and kerf verify have it then. The code that sees it broken counts it.
inline constexpr std::array run_laws = std::to_array<RunLaw>(
    {{"input_faces_missing", &RunVerification::input_faces_missing, "facets of the input missing"},
     {"extra_boundary_faces", &RunVerification::extra_boundary_faces,
      "boundary faces that are neither input nor interface"},
     {"unmatched_interface_faces", &RunVerification::unmatched_interface_faces,
      "interface triangles without a partner of opposite orientation"},
     {"wrong_neighbours", &RunVerification::wrong_neighbours, "interface triangles that name the wrong neighbour",
      true},
     {"inverted_tets", &RunVerification::inverted_tets, "tetrahedra that are not positively oriented"},
     {"tets_without_volume", &RunVerification::tets_without_volume, "tetrahedra whose volume rounds to nothing"},
     {"tets_zero_parts", &RunVerification::tets_zero_parts, "parts without tetrahedra"},
     {"changed_volumes", &RunVerification::changed_volumes, "regions whose volume is not that of the file"},
     {"moved_vertices", &RunVerification::moved_vertices,
      "vertices whose coordinates differ between parts or from the input", true},
     {"misnumbered", &RunVerification::misnumbered, "wrong global vertex numbers", true},
     {"unequal_edge_nodes", &RunVerification::unequal_edge_nodes, "edges whose nodes differ between parts", true},
     {"invalid_curved_cells", &RunVerification::invalid_curved_cells, "curved cells that are not proven valid", true}});

/// Seconds of wall clock, the longest over the ranks.
struct StageSeconds {
    double read = 0, decompose = 0;
    double prepare = 0;  ///< both sides of interfaces brought together, surfaces and jobs written
    double mesh = 0;     ///< the stage in which workers mesh
    double write = 0;    ///< the files of all formats
    double hash = 0;     ///< other files read again for the list of their hashes
    double wall = 0;     ///< the whole run
    double curve = 0;    ///< nodes of order 2 numbered and put on the surface
};

/// Seconds of the workers in the meshing stage, each a mean over all of them: the terms add up to StageSeconds::mesh.
struct WorkerSeconds {
    double mesher = 0;  ///< calls of the mesher
    double verify = 0, store = 0;
    double start = 0;  ///< starting processes, handing over jobs and answers, attempts that failed
    double idle = 0;   ///< waiting with nothing left to do
};

/// The mesh of the whole in one piece, by the same mesher with the same bounds.
struct Reference {
    PartOutcome outcome;     ///< its code is 0 if there is a mesh
    std::string comparison;  ///< qualities of both as text (files/quality/quality_text.h)
};

/// The fate of the surface's edges in a mesh of second order.
struct CurveReport {
    std::int64_t surface_edges = 0;       ///< edges of the surface that was cut
    std::int64_t curved_edges = 0;        ///< edges of the mesh whose nodes lie on the true surface
    std::int64_t straightened_edges = 0;  ///< edges whose nodes went back to the middle, since a cell was not valid
    std::int64_t moved_nodes = 0;         ///< nodes of edges inside that were moved for the same reason
    std::int64_t curved_cells = 0;     ///< cells that have a node beside the middle of its edge; all are proven valid
    double worst_scaled_jacobian = 1;  ///< smallest of these cells (fill/mesh/curved_tet.h); 1 if there are none
    double volume_gain = 0;            ///< volume that curved edges add to the mesh of straight ones
};

/// The tree of cuts.
struct CutReport {
    std::vector<TreeNode> nodes;    ///< nodes of the tree, ascending by number
    std::int64_t split_facets = 0;  ///< facets of the input that straight cuts have split
};

/// The whole mesh, added up over the parts.
struct MeshReport {
    std::int64_t vertices = 0;      ///< number of distinct vertices
    std::int64_t nodes = 0;         ///< number of vertices and nodes on edges for order 2; 0 for order 1
    std::int64_t curved_nodes = 0;  ///< number of the nodes that are on edges but not in their middle
    std::int64_t tets = 0;
    std::map<std::string, std::int64_t> parts_by_way;  ///< number of parts that were filled, by PartResult::way()
    std::int64_t parts_by_tetgen = 0;                  ///< number of these that TetGen has filled, asked for or not
    FacetRecoveryCounts recovery;
    PartQuality quality;
    Improvement improvement;
    double improve_seconds = 0;  ///< seconds of the improvement in all workers
    SizeRatios sizes;
    std::string hash;
};

/// The folder of the result.
struct FolderReport {
    std::string path;
    std::vector<RunFile> files;   ///< all files of the folder but the report, ascending
    bool kept_valid_run = false;  ///< parts have failed, and an older run without failures has kept the folder's name
};

struct RunReport {
    Input input;         ///< facts about the surface that was cut; the surface itself only if it has several regions
    RunRequest request;  ///< with the choices of the run in place of those that were left open
    SizeField size;      ///< wanted edge lengths
    std::optional<FoundSize> found_size;  ///< size that was found for the number of tetrahedra that was asked for
    int ranks = 1;
    CutReport cut;
    std::vector<PartReport> parts;  ///< all parts, in the order of the tree
    RunVerification verification;
    StageSeconds seconds;
    WorkerSeconds worker_seconds;
    MeshReport mesh;
    double imbalance = 1;  ///< largest over mean of the part seconds summed for each worker
    /// Peak of resident memory: sum over the ranks, each with as many times that of the largest worker as it has
    /// workers.
    std::int64_t peak_rss_bytes = 0;
    std::optional<Reference> reference;  ///< mesh in one piece, on the root rank where it was asked for
    FolderReport folder;
    int exit_code = 0;
    std::optional<CurveReport> curve = {};  ///< fate of edges, for order 2 unless they are to be straight
};

/// Returns report.json as text_with_rows(), sealed (files/io/run_manifest.h): a line for each node of the tree, part
/// and file, some 2.6 kB a part in all. Numbers that are not finite become null.
std::string to_json(const RunReport& report);

/// Returns one line on the changes to a surface beside steps by name and the welding of equal vertices; empty if there
/// are none.
std::string repairs_text(const TidyCounts& tidied, const RepairReport& ladder, const OrientationReport& turned);

/// Returns one line on the result of remeshing.
std::string remeshing_text(const InputRemeshing& done);

enum class ReportDetail {
    brief,  ///< the mesh, its quality, the verdict and the time, and messages that this input alone has
    all
};

/// Returns lines for people: a label, and its text from the twelfth column on.
std::string to_text(const RunReport& report, ReportDetail detail = ReportDetail::all);

/// Returns those of the brief lines that say what was changed, or is not as it was asked for, as "sharp: 12 cells ...".
std::vector<std::string> notes_of(const RunReport& report);
/// Returns likewise the lines on the changes of a surface.
std::vector<std::string> notes_of(const Input& input);

}  // namespace kerf
