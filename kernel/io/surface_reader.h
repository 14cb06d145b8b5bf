// Surface files to triangle soups.
#pragma once

#include <string>
#include <string_view>

#include "surface/soup.h"

namespace kerf {

/// Reads STL (binary or ASCII), OBJ, PLY (ASCII, both binary endians) or OFF, told apart by content, in double
/// precision where the format has it. STL triangles are welded exactly; other formats keep their vertices as they are.
///
/// Polygons of more than three vertices are fan-triangulated. STL solids and OBJ groups become patches. Throws
/// Error(io) for a file that cannot be opened or read, Error(input) for content that is empty, truncated, or malformed,
/// each naming the file, the place (line, byte or facet) and the way out. Memory is bounded by a multiple of the file's
/// size, whatever its header claims. `-` is refused.
Soup read_surface(const std::string& path);

/// The formats by themselves, on the bytes of a file; `path` only serves messages.
Soup read_stl(std::string_view bytes, const std::string& path);
Soup read_obj(std::string_view bytes, const std::string& path);
Soup read_ply(std::string_view bytes, const std::string& path);
Soup read_off(std::string_view bytes, const std::string& path);

}  // namespace kerf
