// The work on one part, inside of a worker process: the part is filled with tetrahedra, verified, measured and stored.
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "files/part/part_store.h"
#include "fill/improve/improve.h"
#include "fill/mesh/quality.h"
#include "fill/mesh/verification.h"
#include "fill/mesh/worst_cells.h"
#include "fill/volume/retries.h"
#include "run/work/inside/size_ratios.h"
#include "surface/complex/surface.h"

namespace kerf {

/// The facts about a part before it is meshed, on which alone the mesh depends.
struct PartJob {
    NodeId part = root_node;
    SurfaceArrays surface;  ///< closed; as mesh_volume() takes it: may touch itself at vertices and along edges
    std::vector<std::int64_t> boundary_id;       ///< #V; global numbers
    std::vector<NodeId> neighbour;               ///< #F; the part on the other side of an interface facet, else none
    std::vector<std::int32_t> contact_vertices;  ///< see Part
    std::vector<UndirectedEdge> contact_edges;
    std::vector<SharedGroup> shared;
    std::vector<SharedEdgeGroup> shared_edges;
    NameTable patch_names;  ///< see Part
    NameTable region_names;
    RegionIndex region;       ///< the region in which the part lies
    double length_scale = 1;  ///< diagonal of the whole input, for the bins of the distributions

    template <class Archive>
    void archive(Archive& a) {
        a(part, surface, boundary_id, neighbour, contact_vertices, contact_edges, shared, shared_edges, patch_names,
          region_names, region, length_scale);
    }
};

/// Returns the part before it is meshed: its boundary alone.
Part part_of_job(const PartJob& job);
/// Returns the part of a job with its cells, of which the boundary is the job's surface. Interior vertices have no
/// global numbers yet: they are -1.
Part part_of_job(const PartJob& job, TetMesh mesh);

/// One attempt at a part, as a worker is told of it.
struct PartAttempt {
    std::string job_file;   ///< path of a file of write_job()
    std::string part_file;  ///< path of the file that write_stored_part() writes
    MesherCall call;
    bool durable = true;  ///< see write_stored_part()

    template <class Archive>
    void archive(Archive& a) {
        a(job_file, part_file, call.fallback, call.options, call.cut_first, durable);
    }
};

/// Smallest dihedral angles before and after the improvement of cells; all 0 where there was none.
struct ImprovedAngles {
    double min_before_deg = 0,
           p1_before_deg = 0;  ///< angle of the worst cell, and below which a hundredth of the cells lies
    double min_after_deg = 0, p1_after_deg = 0;

    ImprovedAngles() = default;
    ImprovedAngles(const Improvement& improvement, const PartQuality& after);
    bool known() const { return min_after_deg > 0; }

    template <class Archive>
    void archive(Archive& a) {
        a(min_before_deg, p1_before_deg, min_after_deg, p1_after_deg);
    }
};

/// The record that the parent keeps of a part; the mesh itself goes from the worker to its file.
struct PartResult {
    int code = 0;          ///< value of ErrorCode, 0: the part is verified and written
    std::string message;   ///< if code
    std::string mesher;    ///< the mesher that has filled the part; empty if none was asked
    std::string strategy;  ///< Filling::strategy
    std::string reason;    ///< Filling::reason
    std::int64_t vertices = 0, interior_vertices = 0, tets = 0;
    std::int64_t core_tets = 0;  ///< Filling::core_tets
    MeshLaws laws;
    PartQuality quality;
    WorstCells worst;
    SizeRatios sizes;  ///< against the sizes of the call, which a fallback may have made larger
    std::array<std::uint64_t, 2> hash = {0, 0};  ///< see hash_part()
    FileHash file_hash = {0, 0};                 ///< hash of the stored part
    FacetRecoveryCounts recovery;                ///< Filling::recovery
    Improvement improvement;                     ///< Filling::improvement
    ImprovedAngles angles;                       ///< before and after the improvement
    double improve_seconds = 0;                  ///< the share of the improvement in mesh_seconds
    double load_seconds = 0, mesh_seconds = 0, verify_seconds = 0, store_seconds = 0;
    std::int64_t peak_rss_bytes = 0;

    /// Returns the way in which the part was filled: the strategy of a mesher that has several, else its name.
    const std::string& way() const { return strategy.empty() ? mesher : strategy; }
    /// Whether TetGen has filled the part or half of it, asked for or not.
    bool is_by_tetgen() const { return mesher == "tetgen" || strategy.find(way_by_tetgen) != std::string::npos; }

    template <class Archive>
    void archive(Archive& a) {
        a(code, message, mesher, strategy, reason, vertices, interior_vertices, tets, core_tets, laws, quality, worst,
          sizes, hash, file_hash, recovery, improvement, angles, improve_seconds, load_seconds, mesh_seconds,
          verify_seconds, store_seconds, peak_rss_bytes);
    }
};

/// Returns the result of a part that did not fit into the memory of its worker.
PartResult out_of_memory();

/// Stores the part of a job again as it is in a file of write_part(), if there is a whole one; if its hash is still the
/// same then, nothing is lost. Throws Error(io) only if it cannot be written.
void restore_stored_part(const std::string& part_file, const std::string& vtu_file, const PartJob& job);

/// Keeps the bytes of a job in a file, from which any worker can take it. Throws Error(io).
void write_job(const std::string& path, const PartJob& job);
/// Returns the job that a file holds. Throws Error(io) if the file cannot be read or is damaged.
PartJob read_job(const std::string& path);

/// Meshes, verifies, measures and stores a part. Never throws kerf::Error: the error comes back as the result's code
/// and message. A part whose laws do not hold is not written and has code `subdomain`. Deterministic but for seconds
/// and memory.
PartResult run_part_job(const PartJob& job, const MesherCall& call, const std::string& part_file, bool durable = true);

}  // namespace kerf
