// Only files of this program are read here (files/part/appended_vtu.h): pugixml parses the XML before the raw bytes, so
// that the elements around these stay open. An array is any element with format="appended", and its place is its offset
// behind the line that ends the header. VertexCount stands only in files of order 2, whose points are more than their
// vertices; its presence tells the order. Counts are limited to 2^56, so that no sum or product of two sizes overflows
// before it is compared with the size of the file.
#include "files/part/inside/vtu_header.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/core/error.h"
#include "files/part/appended_vtu.h"

namespace kerf {

namespace {

// Reads Kerf's own XML.
class HeaderParser {
 public:
    HeaderParser(std::string_view xml, const std::string& path) : path_(path) {
        const pugi::xml_parse_result result =
            document_.load_buffer(xml.data(), xml.size(), pugi::parse_minimal, pugi::encoding_utf8);
        if (result.status != pugi::status_end_element_mismatch || result.offset + 1 < std::ssize(xml))
            fail_damaged_vtu(path, "it does not begin with a complete XML header");
    }

    // Parses the header. `data_position`: place of the first array in the file.
    VtuHeader parse(std::int64_t data_position) const {
        VtuHeader header;
        const pugi::xml_node grid = document_.child("VTKFile").child("UnstructuredGrid");
        const pugi::xml_node piece = grid.child("Piece"), fields = grid.child("FieldData");
        const pugi::xml_node vertex_count = array_of(fields, "VertexCount");
        header.point_count = number(piece, "NumberOfPoints");
        header.cell_count = number(piece, "NumberOfCells");
        header.boundary_vertex_count = to_number(array_of(fields, "BoundaryVertexCount").child_value());
        header.order = vertex_count ? 2 : 1;
        header.vertex_count = header.order == 1 ? header.point_count : to_number(vertex_count.child_value());
        if (header.boundary_vertex_count > header.vertex_count || header.vertex_count > header.point_count)
            fail_damaged_vtu(path_, "it has fewer vertices than its boundary, or fewer points than vertices");
        add_arrays(fields, data_position, header);
        for (const pugi::xml_node& section : piece.children()) add_arrays(section, data_position, header);
        return header;
    }

 private:
    static pugi::xml_node array_of(const pugi::xml_node& section, const char* name) {
        return section.find_child_by_attribute("Name", name);
    }
    void add_arrays(const pugi::xml_node& section, std::int64_t data_position, VtuHeader& header) const {
        for (const pugi::xml_node& array : section.children())
            if (array.attribute("format").value() == std::string_view("appended"))
                header.arrays.push_back({attribute(array, "Name"), attribute(array, "type"),
                                         number(array, "NumberOfComponents"), number(array, "NumberOfTuples"),
                                         data_position + number(array, "offset")});
    }
    std::string attribute(const pugi::xml_node& element, const char* name) const {
        const pugi::xml_attribute found = element.attribute(name);
        if (!found) fail_damaged_vtu(path_, fmt::format("an XML element lacks {}", name));
        return found.value();
    }
    std::int64_t number(const pugi::xml_node& element, const char* name) const {
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

    const std::string& path_;
    pugi::xml_document document_;
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
