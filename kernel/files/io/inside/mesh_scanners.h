// Readers of the mesh formats that hold surfaces, tetrahedra or both.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

class SoupBuilder;

/// Give the builder the content of a file, from its bytes without compression: see read_surface() for the formats and
/// errors. Of cells of higher order the corners are taken. `path` serves messages.
void scan_gmsh(std::string_view bytes, const std::string& path, SoupBuilder& builder);
void scan_medit(std::string_view bytes, const std::string& path, SoupBuilder& builder);

/// Takes the bytes of TetGen's .ele; reads the .node file beside it, too.
void scan_tetgen_cells(std::string_view elements, const std::string& path, SoupBuilder& builder);

/// Take VTK's unstructured grids and surfaces, XML (.vtu, .vtp) and legacy (.vtk, versions up to 5.1): tetrahedra,
/// triangles, polygons and strips of all pieces. Numbers of XML are text, base64 or appended, plain or compressed by
/// zlib, in both orders of bytes, those of legacy files text or big endian. Quadratic tetrahedra and triangles are read
/// by their corners; all other cells with nodes between their corners and other compressions are refused, and other
/// cells noted as ignored. The patch of a triangle is "interface" in parts of Kerf where another part is on the other
/// side; else that of its number in the cell array Patch, which has its name in the field data PatchNames as regions
/// have theirs, or "patch_N"; "surface" where there is none.
///
/// Where a surface is wanted, whole numbers of the cells named Region, else gmsh:physical, medit:ref or attribute as
/// meshio names them, are the volumes of tetrahedra; without tetrahedra the arrays front and back of triangles are the
/// volumes on their sides, -1 for the outside. The names of volumes are the bytes of the field data RegionNames, a zero
/// byte behind each, for the numbers from 0 on or those of RegionNumbers; volumes without a name are "region_N".
void scan_vtu(std::string_view bytes, const std::string& path, SoupBuilder& builder);
void scan_vtk(std::string_view bytes, const std::string& path, SoupBuilder& builder);
/// Tells legacy files by their first bytes, which other formats take for a comment.
inline bool is_legacy_vtk(std::string_view bytes) { return bytes.starts_with("# vtk DataFile"); }
inline constexpr const char* interface_patch = "interface";

}  // namespace kerf
