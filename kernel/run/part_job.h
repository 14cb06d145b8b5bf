// All that happens to one part: filled with tetrahedra, verified, measured, written. Runs inside of a worker process.
#pragma once

#include <string>

#include "io/vtu_writer.h"
#include "mesh/quality.h"
#include "mesh/verification.h"
#include "volume/mesher.h"

namespace kerf {

struct PartJob {
    SurfaceArrays surface;
    PartArrays arrays;
    MesherOptions mesher;
    std::string part_file;    ///< is written
    double length_scale = 1;  ///< diagonal of the whole input, for the bins of the distributions
    std::uint32_t vertex_order_seed = 0;

    template <class Archive>
    void archive(Archive& a) {
        a(surface, arrays.part, arrays.boundary_id, arrays.neighbour, arrays.patch_names, mesher, part_file,
          length_scale, vertex_order_seed);
    }
};

/// What the parent keeps of a part; the mesh itself goes from the worker to its file.
struct PartResult {
    int code = 0;         ///< value of ErrorCode, 0: the part is verified and written
    std::string message;  ///< if code
    std::int64_t vertices = 0, interior_vertices = 0, tets = 0;
    MeshLaws laws;
    PartQuality quality;
    std::array<std::uint64_t, 2> hash = {0, 0};  ///< of surface, keys and mesh
    double mesh_seconds = 0, verify_seconds = 0, write_seconds = 0;
    std::int64_t peak_rss_bytes = 0;

    template <class Archive>
    void archive(Archive& a) {
        a(code, message, vertices, interior_vertices, tets, laws, quality, hash, mesh_seconds, verify_seconds,
          write_seconds, peak_rss_bytes);
    }
};

/// Never throws kerf::Error: it comes back as the result's code and message. A part whose laws do not hold is not
/// written and has code `subdomain`. Deterministic but for seconds and memory.
PartResult run_part_job(const PartJob& job);

/// Serves one job: reads it from standard input, answers on standard output, keeps whatever libraries print apart.
/// `memory_mb` limits the address space (0: not at all). The process ends with its parent. Returns the exit code.
int serve_part_job(std::int64_t memory_mb);

}  // namespace kerf
