// The format is told by the content: a binary STL by its size, which no text meets by chance, the others by their first
// word or, TetGen's lists of numbers, by their first line. The ending of the name is only asked where that leaves a
// doubt. The order of the tests in recognise() matters: the size of STL comes first, since many binary files begin with
// "solid"; then formats that can only be refused are named, before a test further down takes their bytes for its own.
#include "files/io/surface_reader.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/cad_body.h"
#include "files/io/compressed.h"
#include "files/io/file_bytes.h"
#include "files/io/inside/image_formats.h"
#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/stl_format.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/surface_formats.h"
#include "files/io/threemf_file.h"
#include "files/io/zip_archive.h"

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

bool is_count(std::string_view word) { return word.find_first_not_of("0123456789") == std::string_view::npos; }

// TetGen's first line: a number of nodes, then the dimension 3 and more counts, or nothing.
bool begins_like_tetgen(std::string_view bytes, const std::string& path) {
    const std::string name = name_in_archive(path);
    if (name.ends_with(".smesh") || name.ends_with(".poly")) return true;
    TextScanner scanner(bytes, path, '#');
    if (scanner.at_end() || !is_count(scanner.next_word())) return false;
    return scanner.at_line_end() || scanner.next_word() == "3";
}

// Binary MEDIT begins with a 1 in its own order of bytes and a version.
bool is_binary_medit(std::string_view bytes) {
    const bool is_little = bytes.starts_with(std::string_view("\1\0\0\0", 4));
    const bool is_big = bytes.starts_with(std::string_view("\0\0\0\1", 4));
    if (bytes.size() < 8 || (!is_little && !is_big)) return false;
    const char version = bytes[is_little ? 4 : 7];
    return version >= 1 && version <= 4;
}

// Tells texts of two bytes a character, as some programs save them: every other byte of plain letters is zero.
bool is_utf16(std::string_view bytes) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return true;
    constexpr std::size_t looked_at = 32;
    if (bytes.size() < looked_at) return false;
    for (const std::size_t zero : {std::size_t{0}, std::size_t{1}}) {
        bool is_text = true;
        for (std::size_t i = 0; i < looked_at && is_text; ++i)
            is_text = i % 2 == zero ? bytes[i] == '\0' : bytes[i] >= '\t' && bytes[i] < '\x7f';
        if (is_text) return true;
    }
    return false;
}

// Returns the first zero byte of content that is text up to there, and longer than the header of a binary STL.
std::optional<std::size_t> find_nul_in_text(std::string_view bytes) {
    const std::string_view text = without_padding(bytes);
    const std::size_t nul = text.find('\0');
    if (nul == text.npos || nul <= stl_header_size) return {};
    const bool is_text = std::all_of(text.begin(), text.begin() + nul, [](char c) { return c >= '\t' && c < '\x7f'; });
    return is_text ? std::optional(nul) : std::nullopt;
}

// XML is many things.
bool is_vtk_xml(std::string_view bytes, std::string_view word) {
    constexpr std::size_t longest_prologue = 4096;
    return word.starts_with('<') && bytes.substr(0, longest_prologue).find("<VTKFile") != bytes.npos;
}

[[noreturn]] void refuse_zip(std::string_view bytes, const std::string& path) {
    if (is_threemf(bytes))
        throw Error(ErrorCode::input, path +
                                          ": this is a 3MF file, but only single surfaces can be read here. Use "
                                          "kerf check or kerf mesh, or export it as STL, OBJ or PLY.");
    throw Error(ErrorCode::input, path + (name_in_archive(path).ends_with(".3mf")
                                              ? ": this ZIP archive has no 3MF model in it. Export the file again."
                                              : ": this is a ZIP archive. Unpack it and give the surface."));
}

// Returns the content without the bytes that some programs append, for formats without a binary kind.
std::string_view body_of(std::string_view bytes, Reader read) {
    constexpr std::array binary_readers = {read_stl, read_ply, read_gmsh, read_vtu, read_vtk};
    const bool may_be_binary = std::find(binary_readers.begin(), binary_readers.end(), read) != binary_readers.end();
    return may_be_binary ? bytes : without_padding(bytes);
}

// Tells whether a line begins with `begin`.
bool has_line(std::string_view bytes, std::string_view begin) {
    for (std::size_t at = bytes.find(begin); at != bytes.npos; at = bytes.find(begin, at + 1))
        if (at == 0 || bytes[at - 1] == '\n' || bytes[at - 1] == '\r') return true;
    return false;
}

// Tells input of NASTRAN, whose comments begin as the sections of Gmsh's files do.
bool is_nastran(std::string_view bytes) {
    constexpr std::size_t longest_head = 65536;
    const std::string_view head = bytes.substr(0, longest_head);
    if (has_line(head, "$MeshFormat") || has_line(head, "$NOD")) return false;
    return has_line(head, "BEGIN BULK") || has_line(head, "GRID") || has_line(head, "CTRIA3") || has_line(head, "CEND");
}

// Refuses, by name, formats that are known but not read: the bytes of some look like another format.
void refuse_foreign(std::string_view bytes, const std::string& path) {
    if (const std::string_view image = image_format_of(bytes); !image.empty())
        throw Error(ErrorCode::input, path + ": " + image_refusal(image));
    if (bytes.starts_with("***tess"))
        throw Error(ErrorCode::input, path +
                                          ": this is a tessellation of Neper, whose cells are no triangles. Mesh it "
                                          "with neper -M, and give the .msh.");
    const auto refuse = [&](const char* format) {
        throw Error(ErrorCode::input, path + ": this is " + format +
                                          ", which cannot be read here. Convert it to VTK's .vtu or Gmsh's .msh, for "
                                          "example with meshio convert, or export the surface as STL, OBJ or PLY.");
    };
    if (bytes.starts_with("\x89HDF\r\n"))
        refuse(name_in_archive(path).ends_with(".med") ? "a MED file of Salome (HDF5)" : "an HDF5 file");
    if (is_nastran(bytes)) refuse("input of NASTRAN");
    for (const char* keyword : {"*HEADING", "*Heading", "*heading", "*NODE", "*Node", "*node"})
        if (bytes.starts_with(keyword)) refuse("input of Abaqus");
}

Reader recognise(std::string_view bytes, const std::string& path) {
    if (is_binary_stl(bytes)) return read_stl;
    refuse_foreign(bytes, path);
    if (is_legacy_vtk(bytes)) return read_vtk;
    if (is_utf16(bytes)) throw Error(ErrorCode::input, path + ": the text is UTF-16. Save it as ASCII or UTF-8.");
    const std::string_view word = first_word(bytes, path);
    if (word == "ply") return read_ply;
    if (word.ends_with("OFF")) return read_off;
    if (word.starts_with('$')) return read_gmsh;
    if (word == "MeshVersionFormatted") return read_medit;
    if (is_vtk_xml(bytes, word)) return read_vtu;
    if (is_binary_medit(bytes))
        throw Error(ErrorCode::input,
                    path + ": binary MEDIT (.meshb) is not supported. Save the mesh as text (.mesh).");
    if (const auto nul = find_nul_in_text(bytes))
        throw Error(ErrorCode::input, path + ": the text is damaged: byte " + std::to_string(*nul) +
                                          " is zero. Export or copy it again.");
    if (is_zip(bytes)) refuse_zip(bytes, path);
    if (is_ascii_stl(bytes) || holds_nul(without_padding(bytes))) return read_stl;
    if (is_obj_keyword(word)) return read_obj;
    if (begins_like_tetgen(bytes, path)) return read_tetgen;
    if (holds_nul(bytes)) return read_stl;
    throw Error(ErrorCode::input,
                fmt::format("{}: the format is not recognised. Give {}, plain or compressed with gzip or zstd.", path,
                            words_of_surface_formats()));
}

}  // namespace

Soup read_surface(const std::string& path) {
    if (std::optional<HashedSoup> read = read_binary_stl_file(path)) return std::move(read->soup);
    return read_surface_bytes(read_file(path), path);
}

Soup read_surface_bytes(std::string file, const std::string& path) {
    const std::string content = decompress(std::move(file), path);
    std::string_view bytes = content;
    if (bytes.empty()) throw Error(ErrorCode::input, path + ": the file is empty. Export the surface again.");
    if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
    if (const CadFormat cad = cad_format(bytes); cad != CadFormat::none)
        throw Error(ErrorCode::input,
                    fmt::format("{}: this is a CAD file ({}), but only triangles can be read here. Use "
                                "kerf check or kerf mesh, or export it as STL, OBJ or PLY.",
                                path, name(cad)));
    const Reader read = recognise(bytes, path);
    return read(body_of(bytes, read), path);
}

}  // namespace kerf
