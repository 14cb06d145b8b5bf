// MEDIT's .mesh as text: sections of a capitalised keyword, a count and as many lines of numbers, up to the word End.
// Vertices are x y z and a reference, Triangles and Quadrilaterals their corners (from 1) and a reference, which is
// their patch; so are Tetrahedra, whose reference is their volume. TrianglesP2 and TetrahedraP2 have a node for each
// edge, too, which is not used. Every other section is passed over up to the next keyword: edges, ridges, normals,
// required elements.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace {

bool begins_keyword(char c) { return c >= 'A' && c <= 'Z'; }

void read_dimension(TextScanner& scanner) {
    if (scanner.next_integer() != 3)
        scanner.fail("the dimension is not 3. Export the surface with three coordinates per vertex.");
}

void read_vertices(TextScanner& scanner, SoupBuilder& builder) {
    const std::int64_t count = scanner.next_count();
    for (std::int64_t v = 0; v < count; ++v) {
        const double x = scanner.next_real(), y = scanner.next_real(), z = scanner.next_real();
        builder.add_vertex({x, y, z});
        scanner.next_integer();  // the reference
    }
}

// `edges`: number of edges that have a node; these nodes follow the corners.
void pass_over_edges(TextScanner& scanner, int edges, SoupBuilder& builder) {
    if (edges > 0) builder.count_cell_by_corners();
    for (int i = 0; i < edges; ++i) scanner.next_index(1);
}

void read_faces(TextScanner& scanner, std::size_t corner_count, SoupBuilder& builder, int edges = 0) {
    const std::int64_t count = scanner.next_count();
    builder.announce_facets(count);
    std::vector<std::int64_t> corners(corner_count);
    for (std::int64_t f = 0; f < count; ++f) {
        for (std::int64_t& corner : corners) corner = scanner.next_index(1);
        pass_over_edges(scanner, edges, builder);
        builder.set_patch("reference_" + std::to_string(scanner.next_integer()));
        builder.add_polygon(corners, [&](const std::string& what) { scanner.fail(what); });
    }
}

void read_tets(TextScanner& scanner, SoupBuilder& builder, int edges = 0) {
    const std::int64_t count = scanner.next_count();
    std::array<std::int64_t, 4> corners{};
    for (std::int64_t t = 0; t < count; ++t) {
        for (std::int64_t& corner : corners) corner = scanner.next_index(1);
        pass_over_edges(scanner, edges, builder);
        const std::int32_t volume = builder.tets().volume({0, scanner.next_integer()});
        builder.tets().add(
            corners, [&](const std::string& what) { scanner.fail(what); }, volume);
    }
}

// Notes volume elements that are ignored, because the user should know of them.
void note_volume_elements(TextScanner& scanner, std::string_view keyword, SoupBuilder& builder) {
    struct Kind {
        std::string_view keyword;
        const char *one, *many;
    };
    constexpr std::array<Kind, 3> kinds = {
        {{"Hexahedra", "hexahedron", "hexahedra"}, {"Prisms", "prism", "prisms"}, {"Pyramids", "pyramid", "pyramids"}}};
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.keyword == keyword; });
    if (kind == kinds.end()) return;
    const std::int64_t count = scanner.next_count();
    builder.count_other_cells(count);
    builder.note_ignored(count, kind->one, kind->many);
}

void pass_over_section(TextScanner& scanner, std::string_view keyword, SoupBuilder& builder) {
    note_volume_elements(scanner, keyword, builder);
    while (!scanner.at_end() && !begins_keyword(scanner.peek())) scanner.next_word();
}

void read_section(TextScanner& scanner, std::string_view keyword, SoupBuilder& builder) {
    if (keyword == "TrianglesP2") return read_faces(scanner, 3, builder, 3);
    if (keyword == "TetrahedraP2") return read_tets(scanner, builder, 6);
    if (keyword.starts_with("TrianglesP") || keyword.starts_with("QuadrilateralsQ") ||
        (builder.wants_tets() && keyword.starts_with("TetrahedraP")))
        scanner.fail("curved elements (" + std::string(keyword) + ") cannot be read. Export straight triangles" +
                     (builder.wants_tets() ? " and tetrahedra." : "."));
    if (keyword == "Dimension")
        read_dimension(scanner);
    else if (keyword == "Vertices")
        read_vertices(scanner, builder);
    else if (keyword == "Triangles")
        read_faces(scanner, 3, builder);
    else if (keyword == "Quadrilaterals")
        read_faces(scanner, 4, builder);
    else if (keyword == "Tetrahedra")
        read_tets(scanner, builder);
    else
        pass_over_section(scanner, keyword, builder);
}

}  // namespace

void scan_medit(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    TextScanner scanner(bytes, path, '#');
    while (!scanner.at_end()) {
        const std::string_view keyword = scanner.next_word();
        if (keyword == "End") break;
        if (!begins_keyword(keyword.front()))
            scanner.fail("a keyword is expected, not \"" + std::string(keyword.substr(0, 40)) +
                         "\". Correct the number of elements before it or export the surface again.");
        read_section(scanner, keyword, builder);
    }
    builder.tets().name_volumes([](const VolumeKey& key) { return "region_" + std::to_string(key.second); });
}

Soup read_medit(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    scan_medit(bytes, path, builder);
    return builder.finish();
}

}  // namespace kerf
