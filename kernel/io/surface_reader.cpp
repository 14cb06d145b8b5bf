// The format is told by the content: a binary STL by its size, which no text meets by chance, the others by their first
// word. Only TetGen's files, which begin with a number, are told by the ending of their name.
#include "io/surface_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/error.h"
#include "io/compressed.h"
#include "io/file_bytes.h"
#include "io/stl_format.h"
#include "io/text_scanner.h"

namespace kerf {

namespace {

using Reader = Soup (*)(std::string_view bytes, const std::string& path);

std::string_view first_word(std::string_view bytes, const std::string& path) {
    TextScanner scanner(bytes, path, '#');
    return scanner.at_end() ? std::string_view() : scanner.next_word();
}

bool is_obj_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 10> keywords = {"v", "vt", "vn", "vp",     "f",
                                                           "g", "o",  "s",  "usemtl", "mtllib"};
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

Reader recognise(std::string_view bytes, const std::string& path) {
    if (is_binary_stl(bytes)) return read_stl;
    const std::string_view word = first_word(bytes, path);
    if (word == "ply") return read_ply;
    if (word.ends_with("OFF")) return read_off;
    if (word.starts_with('$')) return read_gmsh;
    if (is_ascii_stl(bytes) || holds_nul(bytes)) return read_stl;
    if (word == "MeshVersionFormatted") return read_medit;
    if (is_obj_keyword(word)) return read_obj;
    if (path.ends_with(".smesh") || path.ends_with(".poly")) return read_tetgen;
    throw Error(ErrorCode::input,
                path +
                    ": the format is not recognised. Give STL, OBJ, PLY, OFF, MEDIT's .mesh as text, or TetGen's "
                    ".smesh or .poly.");
}

}  // namespace

Soup read_surface(const std::string& path) { return read_surface_bytes(read_file(path), path); }

Soup read_surface_bytes(std::string file, const std::string& path) {
    const std::string content = decompress(std::move(file), path);
    std::string_view bytes = content;
    if (bytes.empty()) throw Error(ErrorCode::input, path + ": the file is empty. Export the surface again.");
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // byte-order mark of UTF-8
    return recognise(bytes, path)(bytes, path);
}

}  // namespace kerf
