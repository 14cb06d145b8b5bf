#include "files/part/appended_vtu.h"

#include <fmt/format.h>

#include "base/core/xml_text.h"

namespace kerf {

namespace {

// Calls take(section, arrays) with the arrays of each element of the XML, in their order.
template <class Take>
void for_each_section(std::span<const VtuArrayHead> arrays, const Take& take) {
    for (std::size_t begin = 0, end = 0; begin < arrays.size(); begin = end) {
        const std::string_view section = arrays[begin].section;
        while (end < arrays.size() && arrays[end].section == section) ++end;
        take(section, arrays.subspan(begin, end - begin));
    }
}

}  // namespace

std::string vtu_file_begin(std::string_view type) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
        type);
}

std::string vtu_head(std::span<const VtuArrayHead> arrays, std::int64_t points, std::int64_t cells,
                     std::string_view fields) {
    std::string xml = vtu_file_begin("UnstructuredGrid") + "<UnstructuredGrid>\n";
    std::int64_t offset = 0;
    for_each_section(arrays, [&](std::string_view section, std::span<const VtuArrayHead> of_section) {
        xml += fmt::format("<{}>\n", section);
        for (const VtuArrayHead& array : of_section) {
            xml += fmt::format(
                "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" "
                "format=\"appended\" offset=\"{}\"/>\n",
                array.type, array.name, array.components, array.tuples, offset);
            offset += sizeof(std::uint64_t) + array.bytes;
        }
        const bool is_field_data = section == "FieldData";
        if (is_field_data) xml += fields;
        xml += fmt::format("</{}>\n", section);
        if (is_field_data) xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, cells);
    });
    return fmt::format("{}</Piece>\n</UnstructuredGrid>\n{}", xml, vtu_data_begin);
}

std::string number_field(std::string_view type, std::string_view name, std::int64_t number) {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
                       type, name, number);
}

std::string pvtu_text(std::span<const VtuArrayHead> arrays, std::span<const std::string> pieces) {
    std::string xml = vtu_file_begin("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n";
    for_each_section(arrays, [&](std::string_view section, std::span<const VtuArrayHead> of_section) {
        if (section == "FieldData" || section == "Cells") return;
        xml += fmt::format("<P{}>\n", section);
        for (const VtuArrayHead& array : of_section)
            xml += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", array.type,
                               array.name, array.components);
        xml += fmt::format("</P{}>\n", section);
    });
    for (const std::string& piece : pieces) xml += fmt::format("<Piece Source=\"{}\"/>\n", xml_text(piece));
    return xml + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace kerf
