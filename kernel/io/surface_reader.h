// Surface files to triangle soups.
#pragma once

#include <string>
#include <string_view>

#include "surface/soup.h"

namespace kerf {

/// Reads STL (binary or ASCII), OBJ, PLY (ASCII, both binary endians), OFF or MEDIT .mesh (ASCII), told apart by
/// content, or TetGen .smesh or .poly, told by the ending, in double precision where the format has it. STL triangles
/// are welded exactly; other formats keep their vertices as they are.
///
/// Polygons of more than three vertices are fan-triangulated. STL solids, OBJ groups, MEDIT references and TetGen
/// markers become patches. Of MEDIT only vertices and triangles are taken: volume elements, quadrilaterals and all else
/// are passed over. TetGen's hole points and regions are not used. Throws Error(io) for a file that cannot be opened or
/// read, Error(input) for content that is empty, truncated, or malformed, each naming the file, the place (line, byte
/// or facet) and the way out. Memory is bounded by a multiple of the file's size, whatever its header claims. `-` is
/// refused.
Soup read_surface(const std::string& path);

/// The same for the bytes of a file that is already in memory.
Soup read_surface_bytes(std::string file, const std::string& path);

/// The formats by themselves, on the bytes of a file; `path` serves messages, and tells TetGen's .poly from .smesh and
/// where the .node file of one without nodes is.
Soup read_stl(std::string_view bytes, const std::string& path);
Soup read_obj(std::string_view bytes, const std::string& path);
Soup read_ply(std::string_view bytes, const std::string& path);
Soup read_off(std::string_view bytes, const std::string& path);
Soup read_gmsh(std::string_view bytes, const std::string& path);
Soup read_medit(std::string_view bytes, const std::string& path);
Soup read_tetgen(std::string_view bytes, const std::string& path);

}  // namespace kerf
