// VTK's legacy files (.vtk), after "VTK File Formats": three lines, of which the third tells whether numbers are text
// or big-endian bytes, DATASET with its kind, then keywords in some order. Behind a keyword stand counts and types, and
// then its numbers, which in a binary file begin on the next line. Lists of cells are, up to version 4, a count and the
// corners of each; from version 5 on, arrays of offsets and of corners. Behind CELL_DATA and POINT_DATA come arrays of
// these. All arrays are read, as there is no other way past them; few are kept.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/inside/binary_scanner.h"
#include "files/io/inside/image_formats.h"
#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/inside/vtk_cells.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"
#include "files/io/vtk_cell_types.h"

namespace kerf {

namespace legacy_vtk {

using vtu::Cells;

namespace {

enum class Scalar { bit, int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64, string };

struct NamedScalar {
    std::string_view name;
    Scalar type;
};
constexpr std::array scalars = {
    NamedScalar{"bit", Scalar::bit},
    NamedScalar{"char", Scalar::int8},
    NamedScalar{"signed_char", Scalar::int8},
    NamedScalar{"unsigned_char", Scalar::uint8},
    NamedScalar{"short", Scalar::int16},
    NamedScalar{"unsigned_short", Scalar::uint16},
    NamedScalar{"int", Scalar::int32},
    NamedScalar{"vtkidtype", Scalar::int32},  // VTK writes its numbers with 32 bits
    NamedScalar{"unsigned_int", Scalar::uint32},
    NamedScalar{"long", Scalar::int64},
    NamedScalar{"vtktypeint8", Scalar::int8},
    NamedScalar{"vtktypeuint8", Scalar::uint8},
    NamedScalar{"vtktypeint16", Scalar::int16},
    NamedScalar{"vtktypeuint16", Scalar::uint16},
    NamedScalar{"vtktypeint32", Scalar::int32},
    NamedScalar{"vtktypeuint32", Scalar::uint32},
    NamedScalar{"vtktypeint64", Scalar::int64},
    NamedScalar{"unsigned_long", Scalar::uint64},
    NamedScalar{"vtktypeuint64", Scalar::uint64},
    NamedScalar{"float", Scalar::float32},
    NamedScalar{"double", Scalar::float64},
    NamedScalar{"string", Scalar::string},
};

bool is_whole(Scalar type) { return type != Scalar::float32 && type != Scalar::float64 && type != Scalar::string; }

std::string lower_case(std::string_view word) {
    std::string lower(word);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

// Returns a name or a text as it was before blanks and others were written as %20.
std::string decoded(std::string_view word) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                      : -1;
    };
    std::string text;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const bool is_code =
            word[i] == '%' && i + 2 < word.size() && digit(word[i + 1]) >= 0 && digit(word[i + 2]) >= 0;
        text += is_code ? static_cast<char>(digit(word[i + 1]) * 16 + digit(word[i + 2])) : word[i];
        i += is_code ? 2 : 0;
    }
    return text;
}

// Reads keywords, and numbers that are text or bytes.
class Source {
 public:
    Source(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path), text_(bytes, path) {}

    TextScanner& text() { return text_; }
    void set_binary() { is_binary_ = true; }
    bool is_binary() const { return is_binary_; }
    std::string next_keyword() { return lower_case(text_.next_word()); }
    std::int64_t next_count() {
        const std::int64_t count = text_.next_count();
        if (count > std::ssize(bytes_) * 8)
            text_.fail("the file claims " + std::to_string(count) + " values, more than it can hold. Save it again.");
        return count;
    }
    Scalar next_type() {
        const std::string_view word = text_.next_word();
        const std::string lower = lower_case(word);
        for (const auto& [name, type] : scalars)
            if (lower == name) return type;
        text_.fail("the type \"" + std::string(word.substr(0, 40)) + "\" is unknown. Save the file again.");
    }

    /// Returns numbers of a type; of strings, their bytes, each with a zero byte behind it.
    template <class Value>
    std::vector<Value> values(Scalar type, std::int64_t count) {
        if (type == Scalar::string) return is_binary_ ? strings_of_bytes<Value>(count) : strings_of_text<Value>(count);
        if (!is_binary_) return from_text<Value>(count);
        switch (type) {
            case Scalar::bit:
                return from_bits<Value>(count);
            case Scalar::int8:
                return from_bytes<Value, std::int8_t>(count);
            case Scalar::uint8:
                return from_bytes<Value, std::uint8_t>(count);
            case Scalar::int16:
                return from_bytes<Value, std::int16_t>(count);
            case Scalar::uint16:
                return from_bytes<Value, std::uint16_t>(count);
            case Scalar::int32:
                return from_bytes<Value, std::int32_t>(count);
            case Scalar::uint32:
                return from_bytes<Value, std::uint32_t>(count);
            case Scalar::int64:
                return from_bytes<Value, std::int64_t>(count);
            case Scalar::uint64:
                return from_bytes<Value, std::uint64_t>(count);
            case Scalar::float32:
                return from_bytes<Value, float>(count);
            default:
                return from_bytes<Value, double>(count);
        }
    }

    [[noreturn]] void fail(const std::string& what) const { text_.fail(what); }

 private:
    BinaryScanner bytes_behind_line() {
        text_.skip_line();
        return {bytes_, text_.position(), path_, std::endian::big};
    }
    template <class Value>
    std::vector<Value> from_text(std::int64_t count) {
        std::vector<Value> values;
        for (std::int64_t i = 0; i < count; ++i)
            if constexpr (std::is_floating_point_v<Value>)
                values.push_back(text_.next_real());
            else
                values.push_back(text_.next_integer());
        return values;
    }
    template <class Value, class Stored>
    std::vector<Value> from_bytes(std::int64_t count) {
        BinaryScanner scanner = bytes_behind_line();
        if (count > static_cast<std::int64_t>(scanner.left() / sizeof(Stored)))
            scanner.fail("the file ends before " + std::to_string(count) +
                         " values. It is truncated: save or copy it again.");
        std::vector<Value> values(count);
        for (Value& value : values) value = scanner.next<Stored>();
        text_.go_to(scanner.position());
        return values;
    }
    template <class Value>
    std::vector<Value> from_bits(std::int64_t count) {
        const std::vector<std::int64_t> bytes = from_bytes<std::int64_t, std::uint8_t>((count + 7) / 8);
        std::vector<Value> values(count);
        for (std::int64_t i = 0; i < count; ++i) values[i] = bytes[i / 8] >> (7 - i % 8) & 1;
        return values;
    }
    template <class Value>
    std::vector<Value> strings_of_text(std::int64_t count) {
        std::vector<Value> values;
        text_.skip_line();
        for (std::int64_t i = 0; i < count && !text_.at_end(); ++i) {
            for (const char c : decoded(text_.rest_of_line())) values.push_back(static_cast<unsigned char>(c));
            values.push_back(0);
        }
        return values;
    }
    // The first two bits of a string tell how many bytes its length has.
    template <class Value>
    std::vector<Value> strings_of_bytes(std::int64_t count) {
        std::vector<Value> values;
        BinaryScanner scanner = bytes_behind_line();
        for (std::int64_t i = 0; i < count; ++i) {
            const auto first = scanner.next<std::uint8_t>();
            std::uint64_t length = first & 0x3f;
            for (int further = (8 >> (first >> 6)) - 1; further > 0; --further)
                length = length << 8 | scanner.next<std::uint8_t>();
            if (length > scanner.left()) scanner.fail("a text ends too early. The file is truncated: copy it again.");
            for (std::uint64_t c = 0; c < length; ++c) values.push_back(scanner.next<std::uint8_t>());
            values.push_back(0);
        }
        text_.go_to(scanner.position());
        return values;
    }

    std::string_view bytes_;
    const std::string& path_;
    TextScanner text_;
    bool is_binary_ = false;
};

// Reads a file up to its end.
class Reader {
 public:
    Reader(std::string_view bytes, const std::string& path, bool wants_scalars)
        : source_(bytes, path), path_(path), wants_scalars_(wants_scalars) {}

    void read() {
        read_head();
        while (!source_.text().at_end()) read_section(source_.next_keyword());
    }

    const std::vector<double>& coordinates() const { return coordinates_; }
    const std::map<std::string, std::vector<double>>& scalars() const { return scalars_; }
    vtu::Names names(const char* names, const char* numbers) { return vtu::names_of(fields_[names], fields_[numbers]); }

    /// Returns the cells with the arrays that belong to them, that of the regions by its name.
    Cells cells(const std::string& region_array) {
        Cells cells;
        for (const CellList& list : lists_) append(list, cells);
        if (is_grid_) cells.types = types_;
        if (cells.types.size() != cells.ends.size())
            source_.fail("the file has " + std::to_string(cells.ends.size()) + " cells and " +
                         std::to_string(cells.types.size()) + " types of cells. Save it again.");
        const auto of_cells = [&](const std::string& name) {
            const auto found = cell_arrays_.find(name);
            return found == cell_arrays_.end() ? std::vector<std::int64_t>() : found->second;
        };
        cells.neighbours = of_cells(vtu::neighbour_array);
        cells.patches = of_cells(vtu::patch_array);
        cells.regions = of_cells(region_array);
        if (!cells.types.empty() && has_sides()) {
            cells.front = of_cells(vtu::front_array);
            cells.back = of_cells(vtu::back_array);
        }
        for (const auto& [name, numbers] : cell_arrays_)
            if (numbers.size() != cells.types.size())
                source_.fail("its array " + name + " has " + std::to_string(numbers.size()) + " values for " +
                             std::to_string(cells.types.size()) + " cells. Save it again.");
        return cells;
    }
    std::string region_array() const {
        for (const char* name : vtu::region_arrays)
            if (cell_arrays_.contains(name)) return name;
        return {};
    }
    bool has_sides() const { return cell_arrays_.contains(vtu::front_array) && cell_arrays_.contains(vtu::back_array); }

 private:
    // Cells of one kind, as they stand in the file.
    struct CellList {
        std::uint8_t type;  // of surfaces
        std::vector<std::int64_t> corners, ends;
    };
    enum class Of { file, cells, points };

    static void append(const CellList& list, Cells& cells) {
        const std::int64_t before = std::ssize(cells.corners);
        for (const std::int64_t end : list.ends) cells.ends.push_back(before + end);
        cells.corners.insert(cells.corners.end(), list.corners.begin(), list.corners.end());
        cells.types.insert(cells.types.end(), list.ends.size(), list.type);
    }

    void read_head() {
        TextScanner& text = source_.text();
        const std::string_view first = text.rest_of_line();
        is_5_ = first.find("Version 5") != first.npos;
        text.skip_line();  // the title
        const std::string encoding = source_.next_keyword();
        if (encoding != "ascii" && encoding != "binary") source_.fail("neither ASCII nor BINARY. Save the file again.");
        if (encoding == "binary") source_.set_binary();
        if (source_.next_keyword() != "dataset") source_.fail("the word DATASET is expected. Save the file again.");
        const std::string kind = source_.next_keyword();
        if (kind == "structured_points") vtu::fail(path_, image_refusal("an image of VTK"));
        is_grid_ = kind == "unstructured_grid";
        if (!is_grid_ && kind != "polydata")
            vtu::fail(path_, "VTK's " + kind.substr(0, 40) +
                                 " is no surface and no mesh of tetrahedra. Save it as POLYDATA or UNSTRUCTURED_GRID.");
    }

    void read_section(const std::string& keyword) {
        constexpr std::array<std::string_view, 5> lists = {"vertices", "lines", "polygons", "triangle_strips", "cells"};
        if (keyword == "points") return read_points();
        if (const auto list = std::find(lists.begin(), lists.end(), keyword); list != lists.end())
            return read_list(list - lists.begin());
        if (keyword == "cell_types") {
            types_ = source_.values<std::int64_t>(Scalar::int32, source_.next_count());
        } else if (keyword == "cell_data" || keyword == "point_data") {
            of_ = keyword == "cell_data" ? Of::cells : Of::points;
            tuples_ = source_.next_count();
        } else if (keyword == "field") {
            read_fields();
        } else if (keyword == "metadata") {
            pass_over_metadata();
        } else {
            read_attribute(keyword);
        }
    }

    void read_points() {
        const std::int64_t count = source_.next_count();
        const Scalar type = source_.next_type();
        coordinates_ = source_.values<double>(type, 3 * count);
    }

    void read_list(std::size_t place) {
        CellList& list = lists_[place];
        const std::int64_t count = source_.next_count(), size = source_.next_count();
        if (is_5_) return read_offsets(count, size, list);
        const std::vector<std::int64_t> numbers = source_.values<std::int64_t>(Scalar::int32, size);
        std::int64_t at = 0;
        for (std::int64_t cell = 0; cell < count; ++cell) {
            const std::int64_t corners = at < size ? numbers[at] : -1;
            if (corners < 0 || corners >= size - at)
                source_.fail("cell " + std::to_string(cell) + " (counted from 0) ends behind the list. Save it again.");
            list.corners.insert(list.corners.end(), numbers.begin() + at + 1, numbers.begin() + at + 1 + corners);
            list.ends.push_back(std::ssize(list.corners));
            at += corners + 1;
        }
    }

    // The first offset is 0, so that there is one more than cells.
    void read_offsets(std::int64_t offsets, std::int64_t corners, CellList& list) {
        for (const auto& [keyword, count] : {std::pair{"offsets", offsets}, {"connectivity", corners}}) {
            if (offsets == 0 && corners == 0 && !next_is(keyword)) return;
            if (source_.next_keyword() != keyword)
                source_.fail("the word " + std::string(keyword) + " is expected. Save the file again.");
            const Scalar type = source_.next_type();
            (keyword[0] == 'o' ? list.ends : list.corners) = source_.values<std::int64_t>(type, count);
        }
        if (list.ends.empty()) return;
        if (list.ends.front() != 0) source_.fail("the offsets of cells do not begin with 0. Save the file again.");
        list.ends.erase(list.ends.begin());
    }

    bool next_is(std::string_view keyword) {
        TextScanner& text = source_.text();
        const std::size_t here = text.position();
        const bool is_it = !text.at_end() && source_.next_keyword() == keyword;
        text.go_to(here);
        return is_it;
    }

    // Metadata end with an empty line.
    void pass_over_metadata() {
        source_.text().skip_line();
        while (!source_.text().rest_of_line().empty()) {
        }
    }

    void read_fields() {
        source_.text().next_word();
        for (std::int64_t left = source_.next_count(); left > 0; --left) {
            while (next_is("metadata")) {
                source_.next_keyword();
                pass_over_metadata();
            }
            const std::string name = decoded(source_.text().next_word());
            const std::int64_t components = source_.next_count(), tuples = source_.next_count();
            read_array(name, source_.next_type(), components, tuples);
        }
    }

    // Reads an array of the cells or points whose kind is a keyword.
    void read_attribute(const std::string& keyword) {
        constexpr std::array<std::pair<std::string_view, int>, 7> kinds = {{{"vectors", 3},
                                                                            {"normals", 3},
                                                                            {"tensors", 9},
                                                                            {"tensors6", 6},
                                                                            {"global_ids", 1},
                                                                            {"pedigree_ids", 1},
                                                                            {"edge_flags", 1}}};
        const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == keyword; });
        const bool is_scalars = keyword == "scalars", is_texture = keyword == "texture_coordinates";
        const bool is_colors = keyword == "color_scalars" || keyword == "lookup_table";
        if (kind == kinds.end() && !is_scalars && !is_texture && !is_colors)
            source_.fail("the keyword \"" + keyword.substr(0, 40) + "\" is unknown. Save the file again.");
        const std::string name = decoded(source_.text().next_word());
        if (is_colors) return pass_over_colors(keyword == "lookup_table");
        if (is_texture) {
            const std::int64_t components = source_.next_count();
            return read_array(name, source_.next_type(), components, tuples_);
        }
        const Scalar type = source_.next_type();
        std::int64_t components = is_scalars ? 1 : kind->second;
        if (is_scalars && !source_.text().at_line_end()) components = source_.next_count();
        if (is_scalars && next_is("lookup_table")) {
            source_.text().next_word();
            source_.text().next_word();
        }
        read_array(name, type, components, tuples_);
    }

    // Colours are bytes in a binary file, real numbers in a text.
    void pass_over_colors(bool is_table) {
        const std::int64_t count = source_.next_count();
        const Scalar type = source_.is_binary() ? Scalar::uint8 : Scalar::float32;
        source_.values<double>(type, is_table ? 4 * count : count * tuples_);
    }

    void read_array(const std::string& name, Scalar type, std::int64_t components, std::int64_t tuples) {
        constexpr std::int64_t most_components = 1 << 20;
        if (components > most_components)
            source_.fail("the array " + name + " has too many values. Save the file again.");
        const std::int64_t count = components * tuples;
        const bool is_name =
            std::find(vtu::name_arrays.begin(), vtu::name_arrays.end(), name) != vtu::name_arrays.end();
        const std::string known = of_ == Of::cells && components == 1 ? vtu::cell_array_of(name, is_whole(type)) : "";
        if (of_ == Of::file && is_name) {
            fields_[name] = source_.values<std::int64_t>(type, count);
        } else if (!known.empty()) {
            cell_arrays_[known] = source_.values<std::int64_t>(type, count);
        } else {
            std::vector<double> values = source_.values<double>(type, count);
            const bool is_scalar = of_ == Of::points && components == 1 && type != Scalar::string;
            if (wants_scalars_ && is_scalar) scalars_.try_emplace(name, std::move(values));
        }
    }

    Source source_;
    const std::string& path_;
    bool wants_scalars_;
    bool is_5_ = false, is_grid_ = false;
    Of of_ = Of::file;         // what arrays belong to
    std::int64_t tuples_ = 0;  // of these arrays
    std::vector<double> coordinates_;
    std::array<CellList, 5> lists_ = {CellList{vtk_poly_vertex, {}, {}}, CellList{vtk_poly_line, {}, {}},
                                      CellList{vtk_polygon, {}, {}}, CellList{vtk_triangle_strip, {}, {}},
                                      CellList{0, {}, {}}};  // in the order in which arrays count cells
    std::vector<std::int64_t> types_;                        // of cells of a grid
    std::map<std::string, std::vector<std::int64_t>> cell_arrays_, fields_;
    std::map<std::string, std::vector<double>> scalars_;
};

}  // namespace

}  // namespace legacy_vtk

void scan_vtk(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    legacy_vtk::Reader reader(bytes, path, builder.wants_scalars());
    reader.read();
    vtu::CellTaker taker(path, reader.names("PatchNames", "PatchNumbers"), builder);
    const std::string region_array = builder.wants_scalars() ? std::string() : reader.region_array();
    taker.add(reader.coordinates(), reader.cells(region_array));
    for (const auto& [name, values] : reader.scalars())
        if (std::ssize(values) == builder.vertex_count()) builder.tets().scalar(name) = values;
    if (builder.wants_scalars()) return;
    taker.finish(reader.names("RegionNames", "RegionNumbers"), !region_array.empty(), reader.has_sides());
}

Soup read_vtk(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    scan_vtk(bytes, path, builder);
    return builder.finish();
}

}  // namespace kerf
