// The triangles of a page as few bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "html/page_surface.h"

namespace kerf {

/// Of each part, one behind the other: its vertices, each as the differences of its coordinates to the vertex before;
/// its triangles, each as the difference of its first corner to that of the triangle before, and of the second and
/// third to the first. A number has its sign as the lowest bit and is written in groups of seven bits, the lowest
/// first; a byte with its highest bit has another one behind it. Vertices that no triangle has are left in.
std::string packed_surface(const PageSurface& surface);

/// As RFC 4648 has it, with padding.
std::string base64(std::string_view bytes);

}  // namespace kerf
