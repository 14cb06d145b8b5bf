// Reads surface files as triangle soups.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/hash.h"
#include "files/io/cad_body.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Reads STL (binary or ASCII), OBJ, PLY (ASCII, both binary endians), OFF, Gmsh MSH 2 or 4.1 (ASCII, both binary
/// endians), MEDIT .mesh (ASCII), VTK's .vtp, .vtu and legacy .vtk (see scan_vtu()), TetGen .smesh or .poly, each also
/// compressed with gzip or zstd, in double precision where the format has it. The content tells the format. The ending
/// is only asked where the content leaves a doubt: .smesh or .poly for a list of numbers whose first line is not that
/// of TetGen's nodes, .smesh for a first facet that is broken over lines. STL triangles are welded exactly; other
/// formats keep their vertices as they are.
///
/// STL solids, OBJ groups (else objects, else materials), Gmsh's physical groups (else surfaces), MEDIT references,
/// VTK's cell array Patch and TetGen markers become patches. Polygons are cut into fans, see find_fan(); polygons that
/// are not planar or that no fan covers are in Soup::unfit_polygons. Facets of TetGen that have several polygons or
/// holes, or that no fan covers, are triangulated, see triangulate_facet(). Other volume elements, curves and points
/// are passed over; Soup::notes says so. TetGen's hole points are in Soup::holes, its regions in Soup::seeds, by the
/// names "region_ATTRIBUTE". Numbers beyond the doubles are read as the nearest, that is infinite or zero, and "nan" is
/// NaN.
///
/// Tetrahedra of one volume (.msh, .mesh, .vtu, .vtk) are passed over, too; without triangles their skin is the
/// surface. Tetrahedra of two or more volumes give Soup::sides and Soup::region_names: the facets are all faces between
/// two regions and the faces that only one tetrahedron has, each once, the smaller region, or the only one, behind it.
/// Their patch is that of the file's triangle there; else "outer", or "A_to_B" between the regions A and B. Triangles
/// at which no region ends are left out. Volumes are Gmsh's physical groups (else volumes), MEDIT's references
/// ("region_N") and VTK's cell arrays, see scan_vtu(); volumes of the same name are one region. So are the volumes of
/// an MSH 4.1 without tetrahedra whose $Entities say which surfaces bound them, see gmsh::sides_of_surfaces().
///
/// Throws Error(io) for a file that cannot be opened or read, Error(input) for content that is empty, truncated, or
/// malformed, each naming the file, the place (line, byte or facet) and the way out. A binary STL may have up to 49
/// bytes of padding; with more its count of facets is in doubt, and it is refused. Memory is bounded by a multiple of
/// the size of the content, whatever its header claims. `-` is refused.
Soup read_surface(const std::string& path);

/// Reads the bytes of a file that is already in memory.
Soup read_surface_bytes(std::string file, const std::string& path);

/// The surface of a file and the hash of its bytes.
struct HashedSoup {
    Soup soup;
    FileHash hash = {};
    bool is_welded = false;                        ///< no two vertices are equal: weld_exactly() would find nothing
    std::vector<PatchFace> faces_of_patches = {};  ///< of a CAD file, in units of the soup; by the names of patches
};

/// Reads a binary STL that is not compressed as read_surface() does, but block by block: beside the soup, which takes
/// 28 bytes a facet of a closed surface, 4 to 8 are needed a facet. Returns nothing for any other file, also for a
/// binary STL whose size is not that of its facets. Throws as read_surface().
std::optional<HashedSoup> read_binary_stl_file(const std::string& path);

/// Read one format each, from the bytes of a file without compression. `path` serves messages, tells TetGen's .poly
/// from .smesh in doubt, and leads to the .node file beside a .poly without nodes.
Soup read_stl(std::string_view bytes, const std::string& path);
Soup read_obj(std::string_view bytes, const std::string& path);
Soup read_ply(std::string_view bytes, const std::string& path);
Soup read_off(std::string_view bytes, const std::string& path);
Soup read_gmsh(std::string_view bytes, const std::string& path);
Soup read_medit(std::string_view bytes, const std::string& path);
Soup read_tetgen(std::string_view bytes, const std::string& path);
Soup read_vtu(std::string_view bytes, const std::string& path);  ///< .vtp, too
Soup read_vtk(std::string_view bytes, const std::string& path);

}  // namespace kerf
