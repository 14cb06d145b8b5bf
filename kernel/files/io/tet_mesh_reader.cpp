// The scanners of formats give a SoupBuilder vertices, triangles and tetrahedra; here they become a mesh that the rest
// of Kerf can rely on. The format is told by the first word of the text, TetGen's two files by the ending of the name.
// In the file of any program a tetrahedron may have either orientation: the exact sign decides
// (files/io/inside/tet_sign.h), and a negative one has two corners swapped; flat ones stay for the measures to report.
// Nodes that are no corners are dropped only where cells of higher order were read by their corners, so that the
// vertices of all other files keep their numbers. The extent is limited to 1e-90 to 1e90, so that volumes do not leave
// the range of doubles.
#include "files/io/tet_mesh_reader.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "files/io/compressed.h"
#include "files/io/file_bytes.h"
#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/tet_sign.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"

namespace kerf {

namespace {

std::string_view without_byte_order_mark(std::string_view bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    return bytes;
}

void scan_by_content(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    if (is_legacy_vtk(bytes)) return scan_vtk(bytes, path, builder);
    TextScanner scanner(bytes, path, '#');
    const std::string_view word = scanner.at_end() ? std::string_view() : scanner.next_word();
    if (word.starts_with('$')) return scan_gmsh(bytes, path, builder);
    if (word == "MeshVersionFormatted") return scan_medit(bytes, path, builder);
    if (word.starts_with('<')) return scan_vtu(bytes, path, builder);
    throw Error(ErrorCode::input, path +
                                      ": this is no volume mesh that can be read. Give Gmsh's .msh, MEDIT's .mesh as "
                                      "text, VTK's .vtu or .vtk, TetGen's .node or .ele, or the folder of a run.");
}

// The cube of the extent must be a normal number, and so must that of a billionth of it.
void check_extent(const std::vector<Vec3>& vertices, const std::string& path) {
    constexpr double smallest = 1e-90, largest = 1e90;
    Eigen::AlignedBox3d box;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (!vertices[v].allFinite())
            throw Error(ErrorCode::input, path + ": a coordinate of vertex " + std::to_string(v) +
                                              " (counted from 0) is not finite. Correct it or save the mesh again.");
        box.extend(vertices[v]);
    }
    const double diagonal = box.diagonal().stableNorm();
    if (!(diagonal > smallest && diagonal < largest))
        throw Error(ErrorCode::input,
                    fmt::format("{}: the mesh has an extent of {:.3g}, which is too small or too large. Save it in "
                                "another unit.",
                                path, diagonal));
}

std::int64_t turn_negative_tets(TetMesh& mesh) {
    std::int64_t turned = 0;
    for (Tetrahedron& tet : mesh.tets) {
        if (tet_sign(mesh.vertices, tet) >= 0) continue;
        std::swap(tet[2], tet[3]);
        ++turned;
    }
    return turned;
}

std::vector<char> facets_of_interface(const Soup& soup) {
    std::vector<char> is_interface(soup.facets.size(), 0);
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        is_interface[f] = soup.patch_names[soup.patch[f]] == interface_patch;
    return is_interface;
}

// Drops the nodes that no cell has as a corner: of cells of second order those on the edges.
void drop_nodes_between_corners(TetFile& file) {
    std::vector<std::int32_t> number(file.mesh.vertices.size(), -1);
    const auto for_corners = [&](const auto& visit) {
        for (Tetrahedron& tet : file.mesh.tets) std::for_each(tet.begin(), tet.end(), visit);
        for (Triangle& facet : file.facets) std::for_each(facet.begin(), facet.end(), visit);
    };
    for_corners([&](std::int32_t& v) { number[v] = 0; });
    std::int32_t kept = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0) continue;
        number[v] = kept;
        file.mesh.vertices[kept] = file.mesh.vertices[v];
        for (NodeScalar& scalar : file.node_scalars) scalar.values[kept] = scalar.values[v];
        ++kept;
    }
    file.mesh.vertices.resize(kept);
    for (NodeScalar& scalar : file.node_scalars) scalar.values.resize(kept);
    for_corners([&](std::int32_t& v) { v = number[v]; });
}

TetFile finish(SoupBuilder& builder, const std::string& path) {
    TetFile file;
    if (builder.tets().region_names().size() > 1 && !builder.wants_scalars()) {
        file.region_names = builder.tets().region_names();
        file.region_of_tet = builder.tets().regions_of_tets();
    }
    file.mesh.tets = builder.tets().finish();
    file.node_scalars = builder.tets().finish_scalars();
    Soup soup = builder.finish_beside_tets();
    file.is_interface = facets_of_interface(soup);
    file.mesh.vertices = std::move(soup.vertices);
    file.facets = std::move(soup.facets);
    file.notes = std::move(soup.notes);
    if (builder.has_cells_by_corners()) drop_nodes_between_corners(file);
    check_extent(file.mesh.vertices, path);
    file.turned_tets = turn_negative_tets(file.mesh);
    return file;
}

TetFile read_bytes(std::string file, const std::string& path, SoupBuilder::Wanted wanted) {
    const std::string content = decompress(std::move(file), path);
    SoupBuilder builder(path, wanted);
    scan_by_content(without_byte_order_mark(content), path, builder);
    return finish(builder, path);
}

}  // namespace

TetFile read_tet_file(const std::string& path) {
    std::filesystem::path file(path);
    if (file.extension() != ".node" && file.extension() != ".ele") return read_tet_bytes(read_file(path), path);
    const std::string elements = file.replace_extension("ele");
    SoupBuilder builder(elements, SoupBuilder::Wanted::tets);
    scan_tetgen_cells(read_file(elements), elements, builder);
    return finish(builder, elements);
}

TetFile read_tet_bytes(std::string file, const std::string& path) {
    return read_bytes(std::move(file), path, SoupBuilder::Wanted::tets);
}

TetFile read_tets_with_scalars(const std::string& path) {
    return read_bytes(read_file(path), path, SoupBuilder::Wanted::tets_and_scalars);
}

}  // namespace kerf
