// Packs the triangles of a page into few bytes.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "files/html/inside/page_surface.h"

namespace kerf {

/// The values that a field has on a page.
struct ValueRange {
    double least = std::numeric_limits<double>::infinity(), most = -least;
};
inline constexpr int value_steps = 255;

/// Returns the range of each field over all parts.
std::vector<ValueRange> ranges_of(const PageSurface& surface);

/// Returns the surfaces of all parts as bytes, one part behind the other. A part is its vertices, each as the
/// differences of its coordinates to the vertex before; then its triangles, each as the difference of its first corner
/// to that of the triangle before, and of the second and third to the first. A number has its sign as the lowest bit
/// and is written in groups of seven bits, the lowest first; a byte with its highest bit has another one behind it.
/// Vertices that no triangle has are left in. Behind the triangles come the values of each field, a number from 0 to
/// value_steps for each vertex, of which the ends stand for the least and the most value of the field.
std::string packed_surface(const PageSurface& surface, const std::vector<ValueRange>& ranges = {});

/// Returns bytes as base64 of RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace kerf
