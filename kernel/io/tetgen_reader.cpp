// TetGen's .smesh and .poly: four lists of lines, each behind a line with its length. Nodes are a number (from 0 or
// 1), x y z and what may follow; if there are none, they are in the .node file beside. A facet of .smesh is its number
// of corners, the corners and a boundary marker; one of .poly says on a line of its own how many polygons and holes it
// has and its marker. Hole points and regions are read and not used: the nesting of the shells tells the voids.
#include <filesystem>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "io/soup_builder.h"
#include "io/surface_reader.h"
#include "io/text_scanner.h"

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

// The line of .poly before the corners, with the marker.
void read_facet_line(TextScanner& scanner, bool has_marker, SoupBuilder& builder) {
    const std::int64_t polygons = scanner.next_count();
    const std::int64_t holes = scanner.at_line_end() ? 0 : scanner.next_count();
    if (polygons != 1 || holes != 0)
        scanner.fail("a facet has " + std::to_string(polygons) + " polygons and " + std::to_string(holes) +
                     " holes; one polygon without holes can be read. Export the surface as triangles.");
    finish_facet_line(scanner, has_marker, builder);
}

void read_corners(TextScanner& scanner, std::int64_t first_node, std::vector<std::int64_t>& corners) {
    const std::int64_t size = scanner.next_count();
    corners.clear();
    for (std::int64_t i = 0; i < size; ++i) corners.push_back(scanner.next_index(first_node));
}

void read_facets(TextScanner& scanner, bool is_poly, std::int64_t first_node, SoupBuilder& builder) {
    const std::int64_t count = scanner.next_count();
    const bool has_markers = !scanner.at_line_end() && scanner.next_integer() != 0;
    scanner.skip_line();
    std::vector<std::int64_t> corners;
    for (std::int64_t f = 0; f < count; ++f) {
        if (is_poly) read_facet_line(scanner, has_markers, builder);
        read_corners(scanner, first_node, corners);
        finish_facet_line(scanner, has_markers && !is_poly, builder);
        builder.add_polygon(corners, [&](const std::string& what) { scanner.fail(what); });
    }
}

// Hole points or regions: a number and x y z per line; the list may be missing.
void pass_over_points(TextScanner& scanner) {
    const std::int64_t count = scanner.at_end() ? 0 : scanner.next_count();
    for (std::int64_t i = 0; i < count; ++i) {
        scanner.next_integer();
        for (int axis = 0; axis < 3; ++axis) scanner.next_real();
        scanner.skip_line();  // attribute and volume bound of a region
    }
}

}  // namespace

Soup read_tetgen(std::string_view bytes, const std::string& path) {
    TextScanner scanner(bytes, path, '#');
    SoupBuilder builder(path);
    const fs::path file(path);
    const std::int64_t nodes = read_node_count(scanner);
    const std::int64_t first_node = nodes > 0 ? read_nodes(scanner, nodes, builder)
                                              : read_node_file(fs::path(file).replace_extension("node"), builder);
    read_facets(scanner, file.extension() == ".poly", first_node, builder);
    pass_over_points(scanner);  // in holes
    pass_over_points(scanner);  // in regions
    scanner.expect_end("its lists of nodes, facets, holes and regions");
    return builder.finish();
}

}  // namespace kerf
