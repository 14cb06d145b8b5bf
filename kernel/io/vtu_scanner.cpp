// VTU is XML around arrays: Piece > Points, Cells, CellData > DataArray. The values of an array are text, or bytes that
// are base64, in place or behind the tag AppendedData, there perhaps plain. Bytes come behind their number; if a
// compressor is named, behind the number of blocks, the size of a block, that of the last one if it is smaller, and the
// compressed sizes of all. Header and data may be encoded as base64 in one piece or each for itself.
#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "io/binary_scanner.h"
#include "io/compressed.h"
#include "io/mesh_scanners.h"
#include "io/soup_builder.h"
#include "io/surface_reader.h"
#include "io/text_scanner.h"
#include "io/vtk_cell_types.h"

namespace kerf {

namespace {

namespace vtu {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw Error(ErrorCode::input, path + ": " + what);
}

struct Tag {
    std::string_view name;        // with a slash in front at the end of an element
    std::string_view attributes;  // the text of all
    bool is_empty = false;        // an element without content
    std::size_t end = 0;          // behind the tag

    // Empty if it is not there.
    std::string_view value(std::string_view attribute) const {
        for (std::size_t at = 0; (at = attributes.find(attribute, at)) != attributes.npos; at += attribute.size()) {
            const std::string_view rest = attributes.substr(at + attribute.size());
            const bool begins_word = at == 0 || attributes[at - 1] == ' ' || attributes[at - 1] == '\n' ||
                                     attributes[at - 1] == '\t' || attributes[at - 1] == '\r';
            if (!begins_word || rest.size() < 2 || rest[0] != '=' || (rest[1] != '"' && rest[1] != '\'')) continue;
            return rest.substr(2, rest.find(rest[1], 2) - 2);
        }
        return {};
    }
};

// The next tag from a position on, comments and declarations left out; nothing at the end of the text.
std::optional<Tag> next_tag(std::string_view text, std::size_t position, const std::string& path) {
    while (true) {
        const std::size_t begin = text.find('<', position);
        if (begin == text.npos) return {};
        const bool is_comment = text.substr(begin).starts_with("<!--");
        const std::string_view closing = is_comment ? "-->" : ">";
        const std::size_t end = text.find(closing, begin);
        if (end == text.npos) fail(path, "a tag does not end. The file is truncated: save or copy it again.");
        position = end + closing.size();
        if (is_comment || text[begin + 1] == '?' || text[begin + 1] == '!') continue;
        std::string_view inside = text.substr(begin + 1, end - begin - 1);
        const bool is_empty = inside.ends_with('/');
        if (is_empty) inside.remove_suffix(1);
        const std::size_t name_end = std::min(inside.size(), inside.find_first_of(" \t\r\n"));
        return Tag{inside.substr(0, name_end), inside.substr(name_end), is_empty, position};
    }
}

struct Array {
    std::string type, format;
    std::string_view content;  // between the tags
    std::int64_t offset = 0;   // of an appended array
};

struct Piece {
    std::int64_t points = 0, cells = 0;
    std::map<std::string, Array> scalars;  // of PointData
    std::map<std::string, Array> arrays;   // "Points", "connectivity", ...; in CellData "Neighbour" alone
};

struct File {
    bool has_long_headers = false, is_compressed = false, is_appended_base64 = false;
    std::endian order = std::endian::little;
    std::string_view appended;  // behind the underscore
    std::vector<Piece> pieces;
};

// Bytes of an array one after the other, from base64 or as they are.
class Bytes {
 public:
    Bytes(std::string_view text, bool is_base64, const std::string& path)
        : text_(text), is_base64_(is_base64), path_(path) {}

    std::string next(std::uint64_t size) {
        if (size > text_.size() + rest_.size()) fail_short();
        if (!is_base64_) {
            const std::string bytes(text_.substr(0, size));
            text_.remove_prefix(size);
            return bytes;
        }
        while (rest_.size() < size) decode_group();
        std::string bytes = rest_.substr(0, size);
        rest_.erase(0, size);
        return bytes;
    }

 private:
    [[noreturn]] void fail_short() const {
        fail(path_, "an array ends too early. The file is truncated: save or copy it again.");
    }
    // Four letters, the last ones of which are = where an encoding ends.
    void decode_group() {
        std::uint32_t value = 0;
        int letters = 0, padding = 0;
        while (letters < 4) {
            if (text_.empty()) fail_short();
            const char c = text_.front();
            text_.remove_prefix(1);
            if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
            if (c == '=') ++padding;
            value = value << 6 | digit(c);
            ++letters;
        }
        for (int byte = 0; byte < 3 - padding; ++byte)
            rest_ += static_cast<char>(static_cast<unsigned char>(value >> (16 - 8 * byte)));
    }
    std::uint32_t digit(char c) const {
        if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
        if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
        if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
        if (c == '+') return 62;
        if (c == '/') return 63;
        if (c == '=') return 0;
        if (c == '<') fail_short();
        fail(path_, "an array is not base64. Save or copy the file again.");
    }

    std::string_view text_;
    bool is_base64_;
    const std::string& path_;
    std::string rest_;  // decoded and not asked for yet
};

class Decoder {
 public:
    Decoder(const File& file, const std::string& path) : file_(file), path_(path) {}

    /// The values of an array of a piece, which must be `count`.
    template <class Value>
    std::vector<Value> values(const Piece& piece, const std::string& name, std::int64_t count) const {
        const auto found = piece.arrays.find(name);
        if (found == piece.arrays.end()) fail(path_, "it has no array " + name + ". Save it again.");
        std::vector<Value> result = values_of<Value>(found->second);
        if (count < 0 || result.size() != static_cast<std::size_t>(count))
            fail(path_, "its array " + name + " has " + std::to_string(result.size()) + " values, not " +
                            std::to_string(count) + ". Save or copy it again.");
        return result;
    }
    template <class Value>
    std::vector<Value> values_of(const Array& array) const {
        if (array.format == "ascii") return from_text<Value>(array.content);
        const std::string bytes = bytes_of(array);
        const std::string& type = array.type;
        if (type == "Float64") return from_bytes<Value, double>(bytes);
        if (type == "Float32") return from_bytes<Value, float>(bytes);
        if (type == "Int64") return from_bytes<Value, std::int64_t>(bytes);
        if (type == "UInt64") return from_bytes<Value, std::uint64_t>(bytes);
        if (type == "Int32") return from_bytes<Value, std::int32_t>(bytes);
        if (type == "UInt32") return from_bytes<Value, std::uint32_t>(bytes);
        if (type == "Int16") return from_bytes<Value, std::int16_t>(bytes);
        if (type == "UInt16") return from_bytes<Value, std::uint16_t>(bytes);
        if (type == "Int8") return from_bytes<Value, std::int8_t>(bytes);
        if (type == "UInt8") return from_bytes<Value, std::uint8_t>(bytes);
        fail(path_, "an array has values of type '" + type.substr(0, 40) + "', which is none of VTK. Save it again.");
    }

 private:
    template <class Value>
    std::vector<Value> from_text(std::string_view text) const {
        std::vector<Value> values;
        for (TextScanner scanner(text, path_); !scanner.at_end();)
            if constexpr (std::is_floating_point_v<Value>)
                values.push_back(scanner.next_real());
            else
                values.push_back(scanner.next_integer());
        return values;
    }
    template <class Value, class Stored>
    std::vector<Value> from_bytes(const std::string& bytes) const {
        if (bytes.size() % sizeof(Stored)) fail(path_, "an array ends within a value. Save or copy it again.");
        std::vector<Value> values(bytes.size() / sizeof(Stored));
        BinaryScanner scanner(bytes, 0, path_, file_.order);
        for (Value& value : values) value = static_cast<Value>(scanner.next<Stored>());
        return values;
    }
    std::string bytes_of(const Array& array) const {
        if (array.format == "appended") {
            if (array.offset < 0 || static_cast<std::uint64_t>(array.offset) > file_.appended.size())
                fail(path_, "an array lies behind the end of the file. It is truncated: save or copy it again.");
            const auto offset = static_cast<std::size_t>(array.offset);
            return decoded({file_.appended.substr(offset), file_.is_appended_base64, path_});
        }
        if (array.format == "binary") return decoded({array.content, true, path_});
        fail(path_,
             "an array has the format '" + array.format.substr(0, 40) + "', which is none of VTK. Save it again.");
    }
    std::uint64_t next_size(Bytes& bytes) const {
        const std::string raw = bytes.next(file_.has_long_headers ? sizeof(std::uint64_t) : sizeof(std::uint32_t));
        BinaryScanner scanner(raw, 0, path_, file_.order);
        return file_.has_long_headers ? scanner.next<std::uint64_t>() : scanner.next<std::uint32_t>();
    }
    std::string decoded(Bytes bytes) const {
        const std::uint64_t count = next_size(bytes);
        if (!file_.is_compressed) return bytes.next(count);
        const std::uint64_t block = next_size(bytes), last = next_size(bytes);
        std::vector<std::uint64_t> sizes;
        for (std::uint64_t i = 0; i < count; ++i) sizes.push_back(next_size(bytes));
        std::string content;
        for (std::size_t i = 0; i < sizes.size(); ++i)
            content += inflate_block(bytes.next(sizes[i]), i + 1 == sizes.size() && last ? last : block, path_);
        return content;
    }

    const File& file_;
    const std::string& path_;
};

void read_root(const Tag& tag, File& file, const std::string& path) {
    if (tag.value("type") == "PUnstructuredGrid")
        fail(path, "this is a list of parts. Name the folder of the run or one of the parts.");
    if (tag.value("type") != "UnstructuredGrid")
        fail(path, "VTK's " + std::string(tag.value("type").substr(0, 40)) +
                       " is no mesh of tetrahedra. Save it as an unstructured grid (.vtu).");
    file.has_long_headers = tag.value("header_type") == "UInt64";
    file.order = tag.value("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    const std::string_view compressor = tag.value("compressor");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail(path, "the compression " + std::string(compressor.substr(0, 40)) +
                       " cannot be read. Save it with vtkZLibDataCompressor or without one.");
    file.is_compressed = !compressor.empty();
}

std::int64_t count_in(const Tag& tag, std::string_view attribute, const std::string& path) {
    const std::string_view text = tag.value(attribute);
    TextScanner scanner(text, path);
    constexpr std::int64_t most = std::int64_t{1} << 60;  // three times as many are still a number
    const std::int64_t count = text.empty() ? 0 : scanner.next_count();
    if (count > most) fail(path, "it claims " + std::to_string(count) + " elements. Save it again.");
    return count;
}

// The array that begins with this tag, and whose element ends at `end`.
Array read_array(std::string_view text, const Tag& tag, std::size_t end, const std::string& path) {
    Array array{std::string(tag.value("type")), std::string(tag.value("format")), {}, count_in(tag, "offset", path)};
    if (array.format.empty()) array.format = "ascii";
    array.content = text.substr(tag.end, end - tag.end);
    return array;
}

// Everything but the values.
File read_structure(std::string_view text, const std::string& path) {
    File file;
    std::string section;
    std::optional<Tag> tag = next_tag(text, 0, path);
    if (!tag || tag->name != "VTKFile") fail(path, "it does not begin as a VTK file. Save it as .vtu.");
    read_root(*tag, file, path);
    while ((tag = next_tag(text, tag->end, path))) {
        if (tag->name == "Piece") {
            file.pieces.push_back(
                {count_in(*tag, "NumberOfPoints", path), count_in(*tag, "NumberOfCells", path), {}, {}});
        } else if (tag->name == "DataArray" && !file.pieces.empty()) {
            const std::size_t end = tag->is_empty ? tag->end : std::min(text.size(), text.find('<', tag->end));
            const std::string name(section == "Points" ? "Points" : tag->value("Name"));
            if (section == "Points" || section == "Cells" || (section == "CellData" && name == "Neighbour"))
                file.pieces.back().arrays.try_emplace(name, read_array(text, *tag, end, path));
            const std::string_view components = tag->value("NumberOfComponents");
            if (section == "PointData" && (components.empty() || components == "1"))
                file.pieces.back().scalars.try_emplace(name, read_array(text, *tag, end, path));
        } else if (tag->name == "AppendedData") {
            const std::size_t begin = text.find('_', tag->end);
            if (begin == text.npos) fail(path, "its appended data are missing. The file is truncated: copy it again.");
            file.is_appended_base64 = tag->value("encoding") != "raw";
            file.appended = text.substr(begin + 1);
            return file;
        } else if (tag->name != "DataArray" && tag->name != "/DataArray") {
            section = tag->name;
        }
    }
    return file;
}

struct Cells {
    std::vector<std::int64_t> corners, ends, types, neighbours;
};

Cells read_cells(const Decoder& decoder, const Piece& piece, const std::string& path) {
    Cells cells;
    cells.types = decoder.values<std::int64_t>(piece, "types", piece.cells);
    cells.ends = decoder.values<std::int64_t>(piece, "offsets", piece.cells);
    cells.corners = decoder.values<std::int64_t>(piece, "connectivity", piece.cells ? cells.ends.back() : 0);
    if (piece.arrays.contains("Neighbour"))
        cells.neighbours = decoder.values<std::int64_t>(piece, "Neighbour", piece.cells);
    std::int64_t begin = 0;
    for (const std::int64_t end : cells.ends) {
        if (end < begin || end > static_cast<std::int64_t>(cells.corners.size()))
            fail(path, "the offsets of its cells do not rise. Save it again.");
        begin = end;
    }
    return cells;
}

// Whether the cell is one that a mesh of tetrahedra has.
template <class Fail>
bool add_cell(std::int64_t type, const std::vector<std::int64_t>& corners, bool is_interface, SoupBuilder& builder,
              const Fail& fail_cell) {
    if (has_higher_order(type))
        fail_cell("it is of VTK's type " + std::to_string(type) +
                  ", which has nodes between its corners. Save the mesh with cells of first order.");
    if (type != vtk_tetra && type != vtk_triangle) return false;
    if (corners.size() != (type == vtk_tetra ? 4U : 3U))
        fail_cell("it has " + std::to_string(corners.size()) + " corners. Save the mesh again.");
    builder.set_patch(is_interface ? interface_patch : "surface");
    type == vtk_tetra ? builder.tets().add(corners, fail_cell) : builder.add_polygon(corners, fail_cell);
    return true;
}

void scan_piece(const Decoder& decoder, const Piece& piece, const std::string& path, SoupBuilder& builder) {
    const std::int64_t first_vertex = builder.vertex_count();
    const std::vector<double> coordinates = decoder.values<double>(piece, "Points", 3 * piece.points);
    for (std::size_t i = 0; i < coordinates.size(); i += 3)
        builder.add_vertex({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
    for (const auto& [name, array] : piece.scalars) {
        if (!builder.wants_scalars()) break;
        const std::vector<double> values = decoder.values_of<double>(array);
        if (static_cast<std::int64_t>(values.size()) != piece.points)
            fail(path, "its array " + name + " has not one value for each point. Save or copy it again.");
        std::copy(values.begin(), values.end(), builder.tets().scalar(name).begin() + first_vertex);
    }
    const Cells cells = read_cells(decoder, piece, path);
    std::vector<std::int64_t> corners;
    std::int64_t begin = 0, ignored = 0;
    for (std::size_t cell = 0; cell < cells.types.size(); ++cell) {
        corners.clear();
        for (; begin < cells.ends[cell]; ++begin)  // a negative corner stays one
            corners.push_back(cells.corners[begin] < 0 ? -1 : cells.corners[begin] + first_vertex);
        const bool is_interface = !cells.neighbours.empty() && cells.neighbours[cell] >= 0;
        ignored += !add_cell(cells.types[cell], corners, is_interface, builder, [&](const std::string& what) {
            fail(path, "cell " + std::to_string(cell) + ": " + what);
        });
    }
    builder.note_ignored(ignored, "cell that is no tetrahedron or triangle",
                         "cells that are no tetrahedra or triangles");
}

}  // namespace vtu

}  // namespace

void scan_vtu(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    const vtu::File file = vtu::read_structure(bytes, path);
    const vtu::Decoder decoder(file, path);
    for (const vtu::Piece& piece : file.pieces) vtu::scan_piece(decoder, piece, path, builder);
}

Soup read_vtu(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    scan_vtu(bytes, path, builder);
    if (builder.has_facets()) builder.note_ignored(builder.tets().count(), "tetrahedron", "tetrahedra");
    return builder.finish();
}

}  // namespace kerf
