// STL knows no shared vertices: every facet brings its three corners, which are welded where they are exactly equal, as
// they come. A large binary file is never in memory as a whole.
//
// Binary: 80 bytes of header, a count, 50 bytes per facet, little-endian floats. The normals are ignored: they say
// nothing that the order of the corners does not say, and are wrong in many files.
// ASCII: solid NAME { facet normal x y z outer loop vertex x y z (three times) endloop endfacet } endsolid NAME,
// keywords in any case. A name runs to the end of its line and may hold keywords. Some programs write "end solid", some
// no "endfacet", some no blank behind "endsolid".
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/hash.h"
#include "files/io/cad_body.h"
#include "files/io/compressed.h"
#include "files/io/file_bytes.h"
#include "files/io/inside/stl_format.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"
#include "files/io/zip_archive.h"

namespace kerf {

namespace {

Vec3 read_corner(const char* bytes) {
    std::array<float, 3> p;
    std::memcpy(p.data(), bytes, sizeof p);
    return Vec3(p[0], p[1], p[2]);
}

// Less than a facet behind the claimed ones is padding; more may be facets that the count misses.
bool holds_claimed_facets(std::string_view bytes) {
    if (bytes.size() < stl_header_size) return false;
    return (bytes.size() - stl_header_size) / stl_facet_size == claimed_stl_facets(bytes);
}

[[noreturn]] void refuse_size(std::string_view bytes, const std::string& path) {
    const std::string size = std::to_string(bytes.size()) + " bytes";
    if (bytes.size() < stl_header_size)
        throw Error(ErrorCode::input, path + ": the binary STL is truncated: it ends within its header, after " + size +
                                          ". Export or copy it again.");
    const std::uint64_t claimed = claimed_stl_facets(bytes);
    const std::uint64_t whole = (bytes.size() - stl_header_size) / stl_facet_size;
    const std::string claim = "its header claims " + std::to_string(claimed) + " facets, ";
    if (whole < claimed)
        throw Error(ErrorCode::input, path + ": the binary STL is truncated: " + claim + "but it ends in facet " +
                                          std::to_string(whole) + " (counted from 0), after " + size +
                                          ". Export or copy it again.");
    throw Error(ErrorCode::input, path + ": the binary STL is longer than " + claim + "which end at byte " +
                                      std::to_string(stl_header_size + stl_facet_size * claimed) + " of " + size +
                                      ". Export it again.");
}

// Where a byte was put in between, or lost, the bytes behind it are read as other numbers, some of them of any size.
void refuse_shifted_records(std::string_view bytes, const std::string& path) {
    constexpr double largest = 1e20;
    const std::size_t count = claimed_stl_facets(bytes);
    const std::size_t padding = bytes.size() - stl_header_size - stl_facet_size * count;
    if (padding == 0) return;
    for (std::size_t f = 0; f < count; ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const double coordinate =
                read_corner(bytes.data() + stl_header_size + f * stl_facet_size + 12 * (i + 1)).cwiseAbs().maxCoeff();
            if (!(coordinate >= largest && std::isfinite(coordinate))) continue;
            throw Error(
                ErrorCode::input,
                fmt::format("{}: the binary STL is damaged: it has {} more than its {} facets take, and from "
                            "about facet {} (counted from 0) on its numbers are none of a surface ({:.2g}). "
                            "Export or copy it again.",
                            path, padding == 1 ? "1 byte" : fmt::format("{} bytes", padding), count, f, coordinate));
        }
}

void add_facets(std::string_view bytes, SoupBuilder& builder) {
    constexpr std::size_t most = 64;
    std::vector<Vec3> corners;
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), most * stl_facet_size))) {
        corners.clear();
        for (std::size_t f = 0; f < std::min(most, bytes.size() / stl_facet_size); ++f)
            for (std::size_t i = 0; i < 3; ++i)
                corners.push_back(read_corner(bytes.data() + f * stl_facet_size + 12 * (i + 1)));
        builder.add_separate_facets(corners);
    }
}

void read_binary(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    const std::size_t count = claimed_stl_facets(bytes), size = stl_facet_size * count;
    builder.announce_facets(count);
    if (!holds_claimed_facets(bytes)) refuse_size(bytes, path);
    refuse_shifted_records(bytes, path);
    builder.reserve_separate_facets(count);
    add_facets(bytes.substr(stl_header_size, size), builder);
    builder.note_ignored(bytes.size() - stl_header_size - size, "byte behind the last facet",
                         "bytes behind the last facet");
}

bool is_keyword(std::string_view word, std::string_view keyword) {
    if (word.size() != keyword.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if ((word[i] | 0x20) != keyword[i]) return false;
    return true;
}

[[noreturn]] void refuse(const TextScanner& scanner, std::string_view expected, std::string_view word) {
    scanner.fail("\"" + std::string(expected) + "\" is expected, not \"" + std::string(word.substr(0, 40)) +
                 "\". Correct the line or export the surface again.");
}

void expect(TextScanner& scanner, std::string_view keyword) {
    const std::string_view word = scanner.next_word();
    if (!is_keyword(word, keyword)) refuse(scanner, keyword, word);
}

Vec3 read_vertex(TextScanner& scanner) {
    expect(scanner, "vertex");
    const double x = scanner.next_real(), y = scanner.next_real(), z = scanner.next_real();
    return {x, y, z};
}

bool ends_solid(TextScanner& scanner, std::string_view word) {
    if (is_keyword(word, "end")) expect(scanner, "solid");
    return is_keyword(word, "end") || is_keyword(word.substr(0, 8), "endsolid");
}

// Returns the word behind the facet; counts facets that do not say where they end.
std::string_view read_facet(TextScanner& scanner, SoupBuilder& builder, std::int64_t& without_end) {
    // Exporters write "nan" or "-1.#IND" as the normal of a sliver: it is passed over as words.
    while (!is_keyword(scanner.next_word(), "outer")) continue;
    expect(scanner, "loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) corner = read_vertex(scanner);
    builder.add_separate_facets(corners);
    expect(scanner, "endloop");
    const std::string_view word = scanner.next_word();
    if (is_keyword(word, "facet") || is_keyword(word.substr(0, 8), "endsolid")) {
        ++without_end;
        return word;
    }
    if (!is_keyword(word, "endfacet")) refuse(scanner, "endfacet", word);
    return scanner.next_word();
}

void read_ascii(std::string_view text, const std::string& path, SoupBuilder& builder) {
    TextScanner scanner(text, path);
    std::int64_t without_end = 0;
    for (int solid = 1; !scanner.at_end(); ++solid) {
        expect(scanner, "solid");
        std::string_view name = scanner.rest_of_line();
        if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
        builder.set_patch(name.empty() ? "solid_" + std::to_string(solid) : std::string(name));
        for (std::string_view word = scanner.next_word(); !ends_solid(scanner, word);) {
            if (!is_keyword(word, "facet")) refuse(scanner, "facet\" or \"endsolid", word);
            word = read_facet(scanner, builder, without_end);
        }
        scanner.skip_line();
    }
    if (without_end > 0)
        builder.note(std::to_string(without_end) + " facets end without \"endfacet\", which every facet should have.");
}

}  // namespace

Soup read_stl(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    if (!is_binary_stl(bytes) && is_ascii_stl(bytes))
        read_ascii(without_padding(bytes), path, builder);
    else
        read_binary(bytes, path, builder);
    return builder.finish();
}

std::optional<HashedSoup> read_binary_stl_file(const std::string& path) {
    constexpr std::size_t facets_at_once = 8192;
    FileReader file(path);
    std::string block(std::min(stl_header_size, file.size()), '\0');
    file.read(block);
    if (!is_binary_stl(block, file.size()) || is_archive(block) || is_zip(block) || block.starts_with(utf8_mark) ||
        cad_format(block) != CadFormat::none)
        return {};
    const std::size_t count = claimed_stl_facets(block);
    SoupBuilder builder(path);
    builder.announce_facets(count);
    builder.reserve_separate_facets(count);
    Hasher hasher;
    hasher.add_bytes(block.data(), block.size());
    for (std::size_t f = 0; f < count; f += facets_at_once) {
        block.resize(std::min(facets_at_once, count - f) * stl_facet_size);
        file.read(block);
        hasher.add_bytes(block.data(), block.size());
        add_facets(block, builder);
    }
    return HashedSoup{builder.finish(), hasher.digest(), true};
}

}  // namespace kerf
