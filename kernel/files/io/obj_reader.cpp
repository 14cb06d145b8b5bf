// OBJ: one statement per line; those without geometry are passed over. Corners of a face count from 1, or backwards
// from the last vertex when negative, and may carry texture and normal behind slashes. Faces belong to patches by the
// coarsest division that the file has: groups (g), else objects (o), else materials (usemtl).
#include <array>
#include <string>
#include <vector>

#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace {

// The statement that divides the faces into patches; empty if there is none.
std::string_view find_patch_keyword(std::string_view text, const std::string& path) {
    constexpr std::array<std::string_view, 3> keywords = {"g", "o", "usemtl"};
    std::size_t best = keywords.size();
    for (TextScanner scanner(text, path, '#'); best > 0 && !scanner.at_end(); scanner.skip_line()) {
        if (const char first = scanner.peek(); first == 'v' || first == 'f') continue;  // most lines
        const std::string_view word = scanner.next_word();
        for (std::size_t i = 0; i < best; ++i)
            if (word == keywords[i]) best = i;
    }
    return best < keywords.size() ? keywords[best] : std::string_view();
}

void read_vertex(TextScanner& scanner, SoupBuilder& builder) {
    Vec3 p;
    for (int i = 0; i < 3; ++i) {
        if (scanner.at_line_end())
            scanner.fail("a vertex has less than three coordinates. Correct it or export the surface again.");
        p[i] = scanner.next_real();
    }
    builder.add_vertex(p);
}

std::int64_t read_corner(TextScanner& scanner, std::int64_t vertex_count) {
    const std::int64_t index = scanner.next_integer_before('/');
    if (index == 0) scanner.fail("a face names vertex 0, but OBJ counts from 1. Export the surface again.");
    return index > 0 ? index - 1 : vertex_count + index;
}

void read_face(TextScanner& scanner, SoupBuilder& builder, std::vector<std::int64_t>& corners) {
    corners.clear();
    while (!scanner.at_line_end()) corners.push_back(read_corner(scanner, builder.vertex_count()));
    builder.add_polygon(corners, [&](const std::string& what) { scanner.fail(what); });
}

}  // namespace

Soup read_obj(std::string_view bytes, const std::string& path) {
    const std::string_view patch_keyword = find_patch_keyword(bytes, path);
    SoupBuilder builder(path);
    std::vector<std::int64_t> corners;
    for (TextScanner scanner(bytes, path, '#'); !scanner.at_end();) {
        const std::string_view word = scanner.next_word();
        if (word == "v") {
            read_vertex(scanner, builder);
            scanner.skip_line();  // a weight or a colour may follow
        } else if (word == "f") {
            read_face(scanner, builder, corners);
        } else if (word == patch_keyword) {
            const std::string_view name = scanner.rest_of_line();
            builder.set_patch(name.empty() ? "default" : name);
        } else {
            scanner.skip_line();
        }
    }
    return builder.finish();
}

}  // namespace kerf
