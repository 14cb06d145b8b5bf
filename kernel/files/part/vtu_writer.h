// Writes parts as VTK XML unstructured grids (VTU, PVTU): raw appended data, UInt64 headers, little endian.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/core/hash.h"
#include "files/part/cell_fields.h"
#include "files/part/inside/vtu_header.h"
#include "files/part/part.h"

namespace kerf {

/// The layout of part files, which may differ between two meshes, but not between the files of one: mesh.pvtu says it
/// for all.
struct VtuLayout {
    CellFieldSet fields = default_cell_fields;
    int tag_bytes = 4;         ///< bytes of a value of Part, Patch, Neighbour and Region: 1, 2 or 4
    bool has_regions = false;  ///< there is more than one region
};

/// Returns the layout with the shortest tags that name all parts and patches.
VtuLayout layout_for(const MeshOutline& outline, CellFieldSet fields);

/// Writes DIR/parts/part_XXXX.vtu: the tetrahedra, then the boundary triangles. For order 2 both are quadratic
/// (VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE), and their nodes on edges are points behind the vertices, in the order
/// of Part::edge_nodes.
///
/// The point array is GlobalVertexId (Int64). Cell arrays are Part, Patch, Neighbour (Int8, Int16 or Int32), and
/// Float32 ones of the fields; a boundary triangle carries the quality of the tetrahedron behind it, NaN if there is
/// none; a tetrahedron has Patch and Neighbour -1. Field data are PatchNames (UInt8: the names' bytes in the order of
/// their patches, a zero byte behind each), for a NameTable that is not whole PatchNumbers (Int32), Facet (Int32: the
/// facet of the input of each boundary triangle, -1 on interfaces), BoundaryVertexCount (Int32), and for order 2
/// VertexCount. Where there are several regions, there is a cell array Region, for a boundary triangle that of the
/// tetrahedron behind it, and field data RegionNames and RegionNumbers likewise; where bodies touch without a triangle
/// in common, ContactVertices and ContactEdges (Int32, numbers of vertices). `values` follow the arrays of their kind.
/// A file has 30 bytes a tetrahedron and 4 a field, with tags of one byte. The bytes depend on the part and the layout
/// alone; their hash is returned. Throws Error(io).
FileHash write_part(const std::string& path, const Part& part, const VtuLayout& layout = {},
                    std::span<const PartValues> values = {});

/// Writes DIR/parts/part_XXXX.surface.vtu: the boundary of a part with GlobalVertexId, cell arrays Part, Patch, Facet,
/// Neighbour and, for several regions, Region (Int32), and the same other field data. Returns the hash of its bytes.
/// Throws Error(io).
FileHash write_part_surface(const std::string& path, const Part& part);

/// Return the hashes that write_part() and write_part_surface() would return, without a file.
FileHash hash_of_part(const Part& part, const VtuLayout& layout = {});
FileHash hash_of_part_surface(const Part& part);

/// Returns the PVTU that joins files of write_part(); `pieces` are paths relative to the PVTU's folder. `values`: those
/// of any part, of which names and types count.
std::string pvtu_text(const std::vector<std::string>& pieces, const VtuLayout& layout = {},
                      std::span<const PartValues> values = {});

/// Writes the text of pvtu_text(). Throws Error(io).
void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const VtuLayout& layout = {},
                std::span<const PartValues> values = {});

/// Returns the layout of the part file with this header.
VtuLayout layout_of(const VtuHeader& header);

}  // namespace kerf
