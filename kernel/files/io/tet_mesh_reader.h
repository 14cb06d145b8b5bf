// Reads volume meshes of Kerf and of other programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/ids.h"
#include "files/io/soup_builder.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

/// The volume mesh of a file.
struct TetFile {
    TetMesh mesh;                                 ///< without neighbours; no vertex counts as one of the boundary
    std::vector<Triangle> facets;                 ///< triangles of the file; none where it lists tetrahedra alone
    std::vector<char> is_interface;               ///< #F; in a part of Kerf: another part is on the other side
    std::int64_t turned_tets = 0;                 ///< number of tetrahedra of negative orientation in the file
    std::vector<NodeScalar> node_scalars = {};    ///< filled by read_tets_with_scalars() only
    std::vector<std::string> notes = {};          ///< things passed over: "12 hexahedra were ignored."
    std::vector<std::string> region_names = {};   ///< names as of read_surface(); none if there is one region
    std::vector<RegionIndex> region_of_tet = {};  ///< #T, of several regions; not of read_tets_with_scalars()
};

/// Reads Gmsh MSH 2 or 4.1 (text, binary of both orders of bytes), MEDIT .mesh (text), VTK's VTU and legacy .vtk (see
/// scan_vtu()), each also compressed with gzip or zstd, and TetGen's .node and .ele, of which either may be named.
///
/// Cells of second order are read by their corners, and all other nodes are left out. Tetrahedra of negative
/// orientation are turned. Throws Error(io) for a file that cannot be opened, Error(input) for content that is
/// truncated or malformed, has no tetrahedra, coordinates that are not finite or an extent that no double holds the
/// cube of, each naming the file, the place and the way out.
TetFile read_tet_file(const std::string& path);

/// Reads the bytes of a file that is already in memory, but not TetGen's.
TetFile read_tet_bytes(std::string file, const std::string& path);

/// Reads a file as read_tet_file() does, but not TetGen's, with all scalars at the nodes that a .msh (each view of
/// $NodeData) or .vtu (PointData) holds.
TetFile read_tets_with_scalars(const std::string& path);

}  // namespace kerf
