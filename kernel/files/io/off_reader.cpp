// OFF: the word OFF, the numbers of vertices, facets and edges, x y z per vertex, then per facet its number of corners,
// the corners (from 0) and perhaps a colour. A prefix of C, N or ST says that vertices carry more than x y z.
#include <string>
#include <vector>

#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace {

// True if vertices carry more than coordinates.
bool read_keyword(TextScanner& scanner) {
    const std::string_view word = scanner.next_word();
    if (!word.ends_with("OFF") || word.find_first_not_of("STCN") != word.size() - 3)
        scanner.fail("\"OFF\" in three dimensions is expected, not \"" + std::string(word.substr(0, 40)) +
                     "\". Export the surface again as plain OFF.");
    return word.size() > 3;
}

std::int64_t read_count(TextScanner& scanner) {
    const std::string_view word = scanner.next_word();
    if (word == "BINARY") scanner.fail("binary OFF is not supported. Export the surface as text.");
    return scanner.to_count(word);
}

void read_facet(TextScanner& scanner, SoupBuilder& builder, std::vector<std::int64_t>& corners) {
    const std::int64_t size = read_count(scanner);
    corners.clear();
    for (std::int64_t i = 0; i < size; ++i) corners.push_back(scanner.next_integer());
    builder.add_polygon(corners, [&](const std::string& what) { scanner.fail(what); });
    scanner.skip_line();  // a colour may follow
}

}  // namespace

Soup read_off(std::string_view bytes, const std::string& path) {
    TextScanner scanner(bytes, path, '#');
    SoupBuilder builder(path);
    const bool has_extras = read_keyword(scanner);
    const std::int64_t vertices = read_count(scanner), facets = read_count(scanner);
    builder.announce_facets(facets);
    read_count(scanner);  // of edges; many files say 0
    for (std::int64_t v = 0; v < vertices; ++v) {
        const double x = scanner.next_real(), y = scanner.next_real(), z = scanner.next_real();
        builder.add_vertex({x, y, z});
        if (has_extras) scanner.skip_line();
    }
    std::vector<std::int64_t> corners;
    for (std::int64_t f = 0; f < facets; ++f) read_facet(scanner, builder, corners);
    scanner.expect_end("the " + std::to_string(facets) + " facets that its header claims");
    return builder.finish();
}

}  // namespace kerf
