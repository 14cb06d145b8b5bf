// VTK XML unstructured grids (VTU, PVTU): raw appended data, UInt64 headers, little endian.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hash.h"
#include "mesh/quality.h"
#include "mesh/tet_mesh.h"
#include "surface/surface.h"

namespace kerf {

/// What a part file holds beyond mesh and surface.
struct PartArrays {
    std::int32_t part = 0;                  ///< leaf number in the binary tree
    std::vector<std::int64_t> boundary_id;  ///< #boundary vertices; GlobalVertexId
    std::vector<std::int32_t> neighbour;    ///< #F; the part on the other side of an interface facet, else -1
    std::vector<std::string> patch_names;   ///< names of the input's patches, written as field data
};

/// Writes DIR/parts/part_XXXX.vtu: the tetrahedra, then the boundary triangles.
///
/// Point array GlobalVertexId (Int64). Cell arrays Part, Patch, Facet (of the input), Neighbour (Int32),
/// MinDihedralAngle, MaxDihedralAngle, RadiusEdgeRatio, AspectRatio, Shape (Float32); a boundary triangle carries the
/// quality of the tetrahedron behind it, NaN if there is none; a tetrahedron has Patch, Facet and Neighbour -1. Field
/// data PatchNames (UInt8: the names' bytes in the order of their patches, a zero byte behind each) and
/// BoundaryVertexCount (Int32). Interior vertices are numbered from 0 until
/// number_interior_vertices() is called, because their numbers depend on the other parts. `quality`: see
/// tet_qualities(); `tet_at_facet`: see tets_at_facets(). The bytes depend on the arguments alone; their hash is
/// returned. The file outlives a power cut after the return. Throws Error(io).
FileHash write_part(const std::string& path, const TetMesh& mesh, const SurfaceArrays& surface,
                    std::span<const TetQuality> quality, std::span<const std::int32_t> tet_at_facet,
                    const PartArrays& arrays);

/// A file of write_part(), read once.
struct PartFileHashes {
    /// What write_part() returned for the file, if that has kept its bytes; a call of number_interior_vertices() since
    /// then changes nothing.
    FileHash written = {0, 0};
    FileHash present = {0, 0};  ///< of the bytes as they are
    std::int64_t bytes = 0;
};

/// Throws Error(io) if the file cannot be read or has no header of write_part().
PartFileHashes hash_part_file(const std::string& path);

/// Rewrites the GlobalVertexId of the interior vertices of a file of write_part() in place: they become `first`,
/// `first` + 1, ... Everything else keeps its bytes. Throws Error(io).
void number_interior_vertices(const std::string& path, std::int64_t first);

/// The hashes that write_part() and write_part_surface() would return, without a file.
FileHash hash_of_part(const TetMesh& mesh, const SurfaceArrays& surface, std::span<const TetQuality> quality,
                      std::span<const std::int32_t> tet_at_facet, const PartArrays& arrays);
FileHash hash_of_part_surface(const SurfaceArrays& surface, const PartArrays& arrays);

/// Writes DIR/parts/part_XXXX.surface.vtu: the closed surface with GlobalVertexId, Part, Patch, Neighbour and the same
/// field data. Returns the hash of its bytes. Throws Error(io).
FileHash write_part_surface(const std::string& path, const SurfaceArrays& surface, const PartArrays& arrays);

/// The PVTU that joins files of write_part(); `pieces` are paths relative to the PVTU's folder.
std::string pvtu_text(const std::vector<std::string>& pieces);

/// Writes it. Throws Error(io).
void write_pvtu(const std::string& path, const std::vector<std::string>& pieces);

/// The XML header of a file of write_part() or write_part_surface(): where its arrays lie.
struct VtuHeader {
    struct Array {
        std::string name, type;  ///< type as VTK names it: UInt8, Int32, Float64, ...
        std::int64_t components = 0, tuples = 0;
        std::int64_t position = 0;  ///< of the array's UInt64 size in the file; its values follow
    };
    std::int64_t point_count = 0, cell_count = 0, boundary_vertex_count = 0;
    std::vector<Array> arrays;  ///< in the order of the file

    const Array* find(std::string_view name) const;  ///< nullptr if there is none
};

/// Reads the header from the first bytes of a file, of which vtu_header_limit are enough. Throws Error(io) if it is not
/// a header of this writer; `path` is for the message.
VtuHeader parse_vtu_header(std::string_view begin_of_file, const std::string& path);
inline constexpr std::size_t vtu_header_limit = 16384;

/// Throws the Error(io) for a file that is not as this writer leaves it; `what` is a clause without a full stop.
[[noreturn]] void fail_damaged_vtu(const std::string& path, const std::string& what);

}  // namespace kerf
