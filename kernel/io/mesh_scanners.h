// Formats of meshes that hold surfaces, tetrahedra or both.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

class SoupBuilder;

/// Give the builder what the bytes of a file, without compression, say: see read_surface() for the formats and errors.
/// Of cells of higher order the corners are taken. `path` serves messages.
void scan_gmsh(std::string_view bytes, const std::string& path, SoupBuilder& builder);
void scan_medit(std::string_view bytes, const std::string& path, SoupBuilder& builder);

/// The bytes of TetGen's .ele; reads the .node file beside it, too.
void scan_tetgen_cells(std::string_view elements, const std::string& path, SoupBuilder& builder);

/// VTK's XML unstructured grids (VTU): tetrahedra and triangles of all pieces; numbers as text, base64 or appended,
/// plain or compressed by zlib, in both orders of bytes; of quadratic ones the corners. Other cells are noted as
/// ignored, those of other orders and other compressions refused. The patch of a triangle is "interface" in parts of
/// Kerf where another part is on the other side, else "surface". Where a surface is wanted, whole numbers of the cells
/// named Region, else gmsh:physical, medit:ref or attribute as meshio names them, are the volumes of tetrahedra; the
/// names of these are the bytes of the field data RegionNames, a zero byte behind each, of numbers from 0 or those of
/// RegionNumbers, else "region_N".
void scan_vtu(std::string_view bytes, const std::string& path, SoupBuilder& builder);
inline constexpr const char* interface_patch = "interface";

}  // namespace kerf
