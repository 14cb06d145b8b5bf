// Packs the triangles of a page into few bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "files/html/inside/page_surface.h"

namespace kerf {

/// Returns the surfaces of all parts as bytes, one part behind the other. A part is its vertices, each as the
/// differences of its coordinates to the vertex before; then its triangles, each as the difference of its first corner
/// to that of the triangle before, and of the second and third to the first. A number has its sign as the lowest bit
/// and is written in groups of seven bits, the lowest first; a byte with its highest bit has another one behind it.
/// Vertices that no triangle has are left in.
std::string packed_surface(const PageSurface& surface);

/// Returns bytes as base64 of RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace kerf
