// VTK XML unstructured grids (VTU, PVTU): raw appended data, UInt64 headers, little endian.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/hash.h"
#include "mesh/quality.h"
#include "part/part.h"

namespace kerf {

/// A quality that cells of part files may have.
struct CellField {
    const char* name;   ///< of --fields
    const char* array;  ///< in the file
    double TetQuality::*measure;
};
inline constexpr std::array<CellField, 5> cell_fields = {
    {{"min-dihedral", "MinDihedralAngle", &TetQuality::min_dihedral_deg},
     {"max-dihedral", "MaxDihedralAngle", &TetQuality::max_dihedral_deg},
     {"radius-edge", "RadiusEdgeRatio", &TetQuality::radius_edge},
     {"aspect", "AspectRatio", &TetQuality::aspect},
     {"shape", "Shape", &TetQuality::shape}}};
/// Some of them, by their places.
using CellFieldSet = std::bitset<cell_fields.size()>;

/// Of names with commas between, `all` or `none`; of an empty text the smallest dihedral angle. Throws Error(usage).
CellFieldSet parse_cell_fields(std::string_view list);

/// What may differ between the files of two meshes, but not between those of one: mesh.pvtu says it for all.
struct VtuLayout {
    CellFieldSet fields = 1;  ///< the smallest dihedral angle
    int tag_bytes = 4;        ///< of a value of Part, Patch and Neighbour: 1, 2 or 4
};

/// With the shortest tags that name all parts and patches.
VtuLayout layout_for(const MeshOutline& outline, CellFieldSet fields);

/// Writes DIR/parts/part_XXXX.vtu: the tetrahedra, then the boundary triangles.
///
/// Point array GlobalVertexId (Int64). Cell arrays Part, Patch, Neighbour (Int8, Int16 or Int32), and Float32 ones of
/// the fields; a boundary triangle carries the quality of the tetrahedron behind it, NaN if there is none; a
/// tetrahedron has Patch and Neighbour -1. Field data PatchNames (UInt8: the names' bytes in the order of their
/// patches, a zero byte behind each), Facet (Int32: that of the input, -1 on interfaces, of each boundary triangle) and
/// BoundaryVertexCount (Int32); `values` follow the arrays of their kind. 30 bytes a tetrahedron and 4 a field, with
/// tags of one byte. The bytes depend on the part and the layout alone; their hash is returned. Throws Error(io).
FileHash write_part(const std::string& path, const Part& part, const VtuLayout& layout = {},
                    std::span<const PartValues> values = {});

/// Writes DIR/parts/part_XXXX.surface.vtu: the boundary of a part with GlobalVertexId, cell arrays Part, Patch,
/// Facet and Neighbour (Int32), and the same other field data. Returns the hash of its bytes. Throws Error(io).
FileHash write_part_surface(const std::string& path, const Part& part);

/// The hashes that these would return, without a file.
FileHash hash_of_part(const Part& part, const VtuLayout& layout = {});
FileHash hash_of_part_surface(const Part& part);

/// The PVTU that joins files of write_part(); `pieces` are paths relative to the PVTU's folder. Of `values`, those of
/// any part, names and types count.
std::string pvtu_text(const std::vector<std::string>& pieces, const VtuLayout& layout = {},
                      std::span<const PartValues> values = {});

/// Writes it. Throws Error(io).
void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const VtuLayout& layout = {},
                std::span<const PartValues> values = {});

/// The XML header of a file of write_part() or write_part_surface(): where its arrays lie.
struct VtuHeader {
    struct Array {
        std::string name, type;  ///< type as VTK names it: UInt8, Int32, Float64, ...
        std::int64_t components = 0, tuples = 0;
        std::int64_t position = 0;  ///< of the array's UInt64 size in the file; its values follow
    };
    std::int64_t point_count = 0, cell_count = 0, boundary_vertex_count = 0;
    std::vector<Array> arrays;  ///< in the order of the file

    const Array* find(std::string_view name) const;  ///< the first; nullptr if there is none
    /// The same with a tuple for every cell: those of points, which come first, may have the same name.
    const Array* find_of_cells(std::string_view name) const;
};

/// Reads the header from the first bytes of a file, of which vtu_header_limit are enough. Throws Error(io) if it is not
/// a header of this writer; `path` is for the message.
VtuHeader parse_vtu_header(std::string_view begin_of_file, const std::string& path);
inline constexpr std::size_t vtu_header_limit = 16384;

/// That of the part file with this header, if it is one.
VtuLayout layout_of(const VtuHeader& header);

/// Throws the Error(io) for a file that is not as this writer leaves it; `what` is a clause without a full stop.
[[noreturn]] void fail_damaged_vtu(const std::string& path, const std::string& what);

}  // namespace kerf
