// Surfaces and meshes as the bytes of files of every format that Kerf reads, with coordinates that are read back bit
// for bit (as floats in binary STL).
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "surface/soup/soup.h"

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
/// Patch p has the reference 10 - p; there are a corner and tetrahedra, too.
std::string to_medit(const Soup& soup, const std::vector<Tetrahedron>& tets = {});
/// Patch p has the marker 10 - p. Nodes count from `first`; a point in a hole and a region follow.
std::string to_tetgen(const Soup& soup, int first, bool is_poly);
std::string to_node_list(const Soup& soup, int first);
std::string to_facet_list(const Soup& soup, int first, bool is_poly);

struct MshStyle {
    bool is_msh41 = true, is_binary = false, is_big_endian = false;
};
/// Patch p is the surface 5 + p and the physical group 10 - p with the patch's name. Node tags are sparse and fall;
/// a point, a line and the tetrahedra lie between the triangles or before them.
std::string to_msh(const Soup& soup, const MshStyle& style, const std::vector<Tetrahedron>& tets = {});

/// TetGen's list of tetrahedra, over nodes that count from `first`.
std::string to_element_list(const std::vector<Tetrahedron>& tets, int first);

struct VtuStyle {
    enum class Values { text, base64, compressed_base64, appended, compressed_appended, appended_base64 };
    Values values = Values::text;
    bool is_big_endian = false, has_long_headers = false;
};
/// The tetrahedra, a line and the triangles, in one piece; `neighbours` (#F): the cell array Neighbour, if there is
/// any.
std::string to_vtu(const Soup& soup, const std::vector<Tetrahedron>& tets, const VtuStyle& style,
                   const std::vector<std::int32_t>& neighbours = {});

/// The same with the triangles as polygons of a surface, and the patches as a cell array, but without tetrahedra.
std::string to_vtp(const Soup& soup, const VtuStyle& style);

struct VtkStyle {
    bool is_binary = false, is_version_5 = false, is_grid = false;
};
/// VTK's legacy format: a line and the triangles, as a surface or a grid, of a grid with the tetrahedra before them.
std::string to_vtk(const Soup& soup, const VtkStyle& style, const std::vector<Tetrahedron>& tets = {});

struct SurfaceFile {
    std::string name;  ///< of the format, with the usual ending
    std::string bytes;
};
/// The soup once in every format and encoding.
std::vector<SurfaceFile> to_all_formats(const Soup& soup);
/// A mesh with its boundary in every format and encoding of meshes, but for TetGen's two files.
std::vector<SurfaceFile> to_all_mesh_formats(const Soup& boundary, const std::vector<Tetrahedron>& tets);

}  // namespace kerf::test
