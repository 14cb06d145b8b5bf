// VTK XML unstructured grids (VTU, PVTU): raw appended data, UInt64 headers, little endian.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hash.h"
#include "part/part.h"

namespace kerf {

/// Writes DIR/parts/part_XXXX.vtu: the tetrahedra, then the boundary triangles.
///
/// Point array GlobalVertexId (Int64). Cell arrays Part, Patch, Facet (of the input), Neighbour (Int32),
/// MinDihedralAngle, MaxDihedralAngle, RadiusEdgeRatio, AspectRatio, Shape (Float32); a boundary triangle carries the
/// quality of the tetrahedron behind it, NaN if there is none; a tetrahedron has Patch, Facet and Neighbour -1. Field
/// data PatchNames (UInt8: the names' bytes in the order of their patches, a zero byte behind each) and
/// BoundaryVertexCount (Int32). The bytes depend on the
/// part alone; their hash is returned. Throws Error(io).
FileHash write_part(const std::string& path, const Part& part);

/// Writes DIR/parts/part_XXXX.surface.vtu: the boundary of a part with GlobalVertexId, Part, Patch, Facet, Neighbour
/// and the same field data. Returns the hash of its bytes. Throws Error(io).
FileHash write_part_surface(const std::string& path, const Part& part);

/// The hashes that these would return, without a file.
FileHash hash_of_part(const Part& part);
FileHash hash_of_part_surface(const Part& part);

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
