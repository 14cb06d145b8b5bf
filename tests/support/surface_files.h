// Surfaces as the bytes of files of every format that Kerf reads, with coordinates that are read back bit for bit
// (as floats in binary STL).
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "surface/soup.h"

namespace kerf::test {

template <class Number>
void append(std::string& bytes, Number value, bool swap = false) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (swap) std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
}

std::string to_binary_stl(const Soup& soup, std::string header = "made by a test");
/// One solid per patch, in the order of the patches.
std::string to_ascii_stl(const Soup& soup);
std::string to_obj(const Soup& soup);
std::string to_off(const Soup& soup);
std::string to_ascii_ply(const Soup& soup);
std::string to_binary_ply(const Soup& soup, bool big_endian);
/// Patch p has the reference 10 - p; there are a corner and a tetrahedron, too.
std::string to_medit(const Soup& soup);
/// Patch p has the marker 10 - p. Nodes count from `first`; a point in a hole and a region follow.
std::string to_tetgen(const Soup& soup, int first, bool is_poly);
std::string to_node_list(const Soup& soup, int first);
std::string to_facet_list(const Soup& soup, int first, bool is_poly);

struct MshStyle {
    bool is_msh41 = true, is_binary = false, is_big_endian = false;
};
/// Patch p is the surface 5 + p and the physical group 10 - p with the patch's name. Node tags are sparse and fall;
/// a point, a line and two tetrahedra lie between the triangles and before them.
std::string to_msh(const Soup& soup, const MshStyle& style);

struct SurfaceFile {
    std::string name;  ///< of the format, with the usual ending
    std::string bytes;
};
/// The soup once in every format and encoding.
std::vector<SurfaceFile> to_all_formats(const Soup& soup);

}  // namespace kerf::test
