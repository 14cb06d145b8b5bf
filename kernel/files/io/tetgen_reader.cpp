// TetGen's .smesh and .poly, and .node with .ele.
//
// .smesh and .poly are four lists of lines, each behind a line with its length: nodes, facets, holes and regions. Nodes
// are a number (from 0 or 1), x y z and values that are passed over; if there are none, they are in the .node file
// beside. A facet of .smesh is its number of corners, the corners and a boundary marker; one of .poly says on a line of
// its own how many polygons and holes it has and its marker, then lists its polygons as .smesh does and its holes as
// points. Points of holes and regions of the whole follow, those of regions with an attribute and perhaps the largest
// volume that a cell may have there. Most files are told by their first facet: .poly and .smesh have no keyword.
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "files/io/compressed.h"
#include "files/io/file_bytes.h"
#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;

// The length of a node list, from its first line.
std::int64_t read_node_count(TextScanner& scanner) {
    const std::int64_t count = scanner.next_count();
    if (!scanner.at_line_end() && scanner.next_integer() != 3)
        scanner.fail("the dimension is not 3. Export the surface with three coordinates per node.");
    scanner.skip_line();  // numbers of attributes and markers
    return count;
}

// Returns the number of the first node.
std::int64_t read_nodes(TextScanner& scanner, std::int64_t count, SoupBuilder& builder) {
    std::int64_t first = 0;
    for (std::int64_t v = 0; v < count; ++v) {
        const std::int64_t number = scanner.next_integer();
        if (v == 0) first = number;
        if (first < 0 || first > 1 || number != first + v)
            scanner.fail("the nodes are not numbered one by one from 0 or 1. Export the surface again.");
        const double x = scanner.next_real(), y = scanner.next_real(), z = scanner.next_real();
        builder.add_vertex({x, y, z});
        scanner.skip_line();  // attributes and a marker
    }
    return first;
}

std::int64_t read_node_file(const std::string& path, SoupBuilder& builder) {
    const std::string content = read_file(path);
    TextScanner scanner(content, path, '#');
    const std::int64_t count = read_node_count(scanner);
    return read_nodes(scanner, count, builder);
}

// Reads to the end of the line, which may begin with a marker.
void finish_facet_line(TextScanner& scanner, bool has_marker, SoupBuilder& builder) {
    if (has_marker && !scanner.at_line_end()) builder.set_patch("marker_" + std::to_string(scanner.next_integer()));
    scanner.skip_line();
}

// The line of .poly before the polygons, with the marker.
struct FacetLine {
    std::int64_t polygons = 1, holes = 0;
};

FacetLine read_facet_line(TextScanner& scanner, bool has_marker, SoupBuilder& builder) {
    FacetLine line;
    line.polygons = scanner.next_count();
    line.holes = scanner.at_line_end() ? 0 : scanner.next_count();
    if (line.polygons == 0) scanner.fail("a facet has no polygon. Remove it or export the surface again.");
    finish_facet_line(scanner, has_marker, builder);
    return line;
}

void read_corners(TextScanner& scanner, std::int64_t first_node, std::vector<std::int64_t>& corners) {
    const std::int64_t size = scanner.next_count();
    corners.clear();
    for (std::int64_t i = 0; i < size; ++i) corners.push_back(scanner.next_index(first_node));
}

Vec3 read_coordinates(TextScanner& scanner) {
    const double x = scanner.next_real(), y = scanner.next_real(), z = scanner.next_real();
    return {x, y, z};
}

Vec3 read_hole(TextScanner& scanner) {
    scanner.next_integer();  // its number
    const Vec3 point = read_coordinates(scanner);
    scanner.skip_line();
    return point;
}

// Attributes are real numbers, of which most programs write whole ones.
std::string name_of_region(double attribute) {
    constexpr double largest_whole = 1e15;
    if (std::abs(attribute) <= largest_whole && attribute == std::floor(attribute))
        return fmt::format("region_{}", static_cast<std::int64_t>(attribute));
    return fmt::format("region_{}", attribute);
}

RegionSeed read_region(TextScanner& scanner) {
    const std::int64_t number = scanner.next_integer();
    RegionSeed seed;
    seed.point = read_coordinates(scanner);
    seed.name = name_of_region(scanner.at_line_end() ? number : scanner.next_real());
    const double bound = scanner.at_line_end() ? 0 : scanner.next_real();
    if (bound > 0 && std::isfinite(bound)) seed.largest_cell = bound;
    scanner.skip_line();
    return seed;
}

void read_poly_facet(TextScanner& scanner, bool has_marker, std::int64_t first_node, SoupBuilder& builder,
                     PolygonalFacet& facet) {
    const FacetLine line = read_facet_line(scanner, has_marker, builder);
    for (std::int64_t i = 0; i < line.polygons; ++i) {
        if (i == std::ssize(facet.polygons)) facet.polygons.emplace_back();
        read_corners(scanner, first_node, facet.polygons[i]);
        if (facet.polygons[i].empty())
            scanner.fail("a polygon has no vertices. Remove it or export the surface again.");
        scanner.skip_line();
    }
    facet.polygons.resize(line.polygons);
    facet.holes.clear();
    for (std::int64_t i = 0; i < line.holes; ++i) facet.holes.push_back(read_hole(scanner));
}

void read_smesh_facet(TextScanner& scanner, bool has_marker, std::int64_t first_node, SoupBuilder& builder,
                      PolygonalFacet& facet) {
    facet.polygons.resize(1);
    read_corners(scanner, first_node, facet.polygons[0]);
    if (facet.polygons[0].size() < 3)
        scanner.fail("a facet has less than three vertices. Remove it or export the surface again.");
    finish_facet_line(scanner, has_marker, builder);
}

// True if the first facet is one of .poly: a line of more than three numbers is a facet of .smesh, and a line that
// begins with 1 says in .poly that there is one polygon. The others are facets of .smesh over several lines, or have
// several polygons, as the ending says.
bool is_poly(TextScanner scanner, const std::string& path) {
    if (scanner.at_end()) return false;
    const std::int64_t first = scanner.next_integer();
    int more = 0;
    for (; more < 3 && !scanner.at_line_end(); ++more) scanner.next_word();
    return more < 3 && (first == 1 || !name_in_archive(path).ends_with(".smesh"));
}

void read_facets(TextScanner& scanner, const std::string& path, std::int64_t first_node, SoupBuilder& builder) {
    const std::int64_t count = scanner.next_count();
    builder.announce_facets(count);
    const bool has_markers = !scanner.at_line_end() && scanner.next_integer() != 0;
    scanner.skip_line();
    const bool poly = is_poly(scanner, path);
    const auto read_facet = poly ? read_poly_facet : read_smesh_facet;
    PolygonalFacet facet;  // one for all, because most are small
    for (std::int64_t f = 0; f < count; ++f) {
        read_facet(scanner, has_markers, first_node, builder, facet);
        builder.add_facet_of_polygons(facet, [&](const std::string& what) { scanner.fail(what); });
    }
}

// The length of a list that may be missing.
std::int64_t read_length(TextScanner& scanner) { return scanner.at_end() ? 0 : scanner.next_count(); }

}  // namespace

Soup read_tetgen(std::string_view bytes, const std::string& path) {
    TextScanner scanner(bytes, path, '#');
    SoupBuilder builder(path);
    const std::int64_t nodes = read_node_count(scanner);
    const std::string node_file = fs::path(name_in_archive(path)).replace_extension("node");
    const std::int64_t first_node =
        nodes > 0 ? read_nodes(scanner, nodes, builder) : read_node_file(node_file, builder);
    read_facets(scanner, path, first_node, builder);
    for (std::int64_t i = read_length(scanner); i > 0; --i) builder.add_hole(read_hole(scanner));
    for (std::int64_t i = read_length(scanner); i > 0; --i) builder.add_seed(read_region(scanner));
    scanner.expect_end("its lists of nodes, facets, holes and regions");
    Soup soup = builder.finish();
    soup.may_end_inside = true;
    return soup;
}

void scan_tetgen_cells(std::string_view elements, const std::string& path, SoupBuilder& builder) {
    const std::int64_t first_node = read_node_file(fs::path(path).replace_extension("node"), builder);
    TextScanner scanner(elements, path, '#');
    const std::int64_t count = scanner.next_count(), nodes = scanner.at_line_end() ? 4 : scanner.next_count();
    if (nodes != 4 && nodes != 10)
        scanner.fail("tetrahedra with " + std::to_string(nodes) +
                     " nodes cannot be read. Save the mesh with four nodes each, or ten.");
    scanner.skip_line();  // number of attributes
    std::array<std::int64_t, 4> corners{};
    for (std::int64_t t = 0; t < count; ++t) {
        scanner.next_integer();
        for (std::int64_t& corner : corners) corner = scanner.next_index(first_node);
        scanner.skip_line();  // nodes on edges, attributes
        if (nodes == 10) builder.count_cell_by_corners();
        builder.tets().add(corners, [&](const std::string& what) { scanner.fail(what); });
    }
    scanner.expect_end("its tetrahedra");
}

}  // namespace kerf
