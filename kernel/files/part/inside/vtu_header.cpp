// Only files of this program are read here, so their XML is searched for attributes, not parsed: every element is on
// one line with its attributes in double quotes (files/part/appended_vtu.h). An array is any element with
// format="appended", and its place is its offset behind the line that ends the header. VertexCount stands only in files
// of order 2, whose points are more than their vertices; its presence tells the order. Counts are limited to 2^56, so
// that no sum or product of two sizes overflows before it is compared with the size of the file.
#include "files/part/inside/vtu_header.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/part/appended_vtu.h"

namespace kerf {

namespace {

// Reads Kerf's own XML: elements on one line, attributes in double quotes.
class HeaderParser {
 public:
    HeaderParser(std::string_view xml, const std::string& path) : xml_(xml), path_(path) {}

    // Parses the header. `data_position`: place of the first array in the file.
    VtuHeader parse(std::int64_t data_position) const {
        VtuHeader header;
        const std::string_view piece = element_at(find("<Piece "));
        header.point_count = number(piece, "NumberOfPoints");
        header.cell_count = number(piece, "NumberOfCells");
        header.boundary_vertex_count = to_number(text_between(find("\"BoundaryVertexCount\""), ">", "<"));
        header.order = xml_.find(vertex_count_name) == xml_.npos ? 1 : 2;
        header.vertex_count =
            header.order == 1 ? header.point_count : to_number(text_between(find(vertex_count_name), ">", "<"));
        if (header.boundary_vertex_count > header.vertex_count || header.vertex_count > header.point_count)
            fail_damaged_vtu(path_, "it has fewer vertices than its boundary, or fewer points than vertices");
        constexpr std::string_view marker = "format=\"appended\"";
        for (std::size_t at = xml_.find(marker); at != xml_.npos; at = xml_.find(marker, at + 1)) {
            const std::string_view element = element_at(xml_.rfind('<', at));
            header.arrays.push_back({std::string(attribute(element, "Name")), std::string(attribute(element, "type")),
                                     number(element, "NumberOfComponents"), number(element, "NumberOfTuples"),
                                     data_position + number(element, "offset")});
        }
        return header;
    }

 private:
    static constexpr std::string_view vertex_count_name = "\"VertexCount\"";
    std::size_t find(std::string_view text) const {
        const std::size_t at = xml_.find(text);
        if (at == xml_.npos) fail_damaged_vtu(path_, fmt::format("its XML header has no {}", text));
        return at;
    }
    std::string_view element_at(std::size_t begin) const { return xml_.substr(begin, xml_.find('>', begin) - begin); }
    std::string_view text_between(std::size_t from, std::string_view open, std::string_view close) const {
        const std::size_t begin = xml_.find(open, from) + open.size();
        return xml_.substr(begin, xml_.find(close, begin) - begin);
    }
    std::string_view attribute(std::string_view element, std::string_view name) const {
        const std::string opening = fmt::format(" {}=\"", name);
        const std::size_t begin = element.find(opening);
        if (begin == element.npos) fail_damaged_vtu(path_, fmt::format("an XML element lacks {}", name));
        const std::string_view rest = element.substr(begin + opening.size());
        return rest.substr(0, rest.find('"'));
    }
    std::int64_t number(std::string_view element, std::string_view name) const {
        return to_number(attribute(element, name));
    }
    std::int64_t to_number(std::string_view text) const {
        constexpr std::int64_t most = std::int64_t{1} << 56;  // so that no sum or product of counts overflows
        std::int64_t value = -1;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most)
            fail_damaged_vtu(path_, fmt::format("'{}' in its XML header is no count", text));
        return value;
    }

    std::string_view xml_;
    const std::string& path_;
};

}  // namespace

void fail_damaged_vtu(const std::string& path, const std::string& what) {
    throw Error(ErrorCode::io, fmt::format("{} is damaged or was not written by Kerf: {}. Run the mesher again to "
                                           "replace it.",
                                           path, what));
}

const VtuHeader::Array* VtuHeader::find(std::string_view name) const {
    const auto it = std::find_if(arrays.begin(), arrays.end(), [&](const Array& array) { return array.name == name; });
    return it == arrays.end() ? nullptr : &*it;
}

const VtuHeader::Array* VtuHeader::find_of_cells(std::string_view name) const {
    const auto it = std::find_if(arrays.rbegin(), arrays.rend(),
                                 [&](const Array& array) { return array.name == name && array.tuples == cell_count; });
    return it == arrays.rend() ? nullptr : &*it;
}

VtuHeader parse_vtu_header(std::string_view begin_of_file, const std::string& path) {
    const std::size_t end = begin_of_file.find(vtu_data_begin);
    if (!begin_of_file.starts_with(vtu_file_begin("UnstructuredGrid")) || end == begin_of_file.npos)
        fail_damaged_vtu(path, "it does not begin with a complete XML header");
    return HeaderParser(begin_of_file.substr(0, end), path).parse(end + vtu_data_begin.size());
}

}  // namespace kerf
