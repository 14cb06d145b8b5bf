// 3MF files as the tests need them.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace kerf::test {

/// `bytes` with a number of so many bytes behind them, little endian.
inline void append_number(std::string& bytes, std::size_t number, int size) {
    for (int i = 0; i < size; ++i, number >>= 8) bytes += static_cast<char>(number);
}

/// A ZIP archive of files that are not compressed. `claim`: what its table of contents says more of each than there is.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files, std::size_t claim = 0) {
    std::string bytes, table;
    for (const auto& [name, content] : files) {
        const std::size_t offset = bytes.size();
        const std::size_t sum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), uInt(content.size()));
        const auto append_head = [&](std::string& to, std::size_t more) {
            append_number(to, 20, 2);  // version that is needed
            append_number(to, 0, 8);   // no flags, not compressed, no time
            append_number(to, sum, 4);
            append_number(to, content.size(), 4);
            append_number(to, content.size() + more, 4);
            append_number(to, name.size(), 2);
            append_number(to, 0, 2);  // nothing extra
        };
        bytes += "PK\3\4";
        append_head(bytes, 0);
        bytes += name + content;
        table += "PK\1\2";
        append_number(table, 20, 2);
        append_head(table, claim);
        append_number(table, 0, 10);  // no comment, first disk, no attributes
        append_number(table, offset, 4);
        table += name;
    }
    const std::size_t offset = bytes.size();
    bytes += table + "PK\5\6";
    append_number(bytes, 0, 4);  // first disk
    append_number(bytes, files.size(), 2);
    append_number(bytes, files.size(), 2);
    append_number(bytes, table.size(), 4);
    append_number(bytes, offset, 4);
    append_number(bytes, 0, 2);  // no comment
    return bytes;
}

/// A 3MF file of these resources and build items.
inline std::string threemf(const std::string& resources, const std::string& items,
                           const std::string& unit = "millimeter", std::size_t claim = 0) {
    const std::string package = "http://schemas.openxmlformats.org/package/2006/";
    return zip(
        {{"[Content_Types].xml",
          "<Types xmlns=\"" + package + "content-types\"><Default Extension=\"rels\" ContentType=\"" +
              "application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"model\" " +
              "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>"},
         {"_rels/.rels",
          "<Relationships xmlns=\"" + package + "relationships\"><Relationship Target=\"/3D/3dmodel.model\" " +
              "Id=\"r\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>" + "</Relationships>"},
         {"3D/3dmodel.model", "<model unit=\"" + unit +
                                  "\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">" +
                                  "<resources>" + resources + "</resources><build>" + items + "</build></model>"}},
        claim);
}

/// An object: the unit cube, or what is `mesh`, or `components`.
inline std::string object(int id, const std::string& attributes, const std::string& content) {
    return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>";
}
inline std::string cube() {
    std::string mesh = "<mesh><vertices>";
    for (const char* p :
         {"x=\"0\" y=\"0\" z=\"0\"", "x=\"1\" y=\"0\" z=\"0\"", "x=\"0\" y=\"1\" z=\"0\"", "x=\"1\" y=\"1\" z=\"0\"",
          "x=\"0\" y=\"0\" z=\"1\"", "x=\"1\" y=\"0\" z=\"1\"", "x=\"0\" y=\"1\" z=\"1\"", "x=\"1\" y=\"1\" z=\"1\""})
        mesh += std::string("<vertex ") + p + "/>";
    mesh += "</vertices><triangles>";
    for (const char* t : {"021", "123", "456", "576", "014", "154", "263", "367", "042", "246", "135", "375"})
        mesh += std::string("<triangle v1=\"") + t[0] + "\" v2=\"" + t[1] + "\" v3=\"" + t[2] + "\"/>";
    return mesh + "</triangles></mesh>";
}
/// A build item or a component; the transformation as the file has it, a row for each axis and one for the shift.
inline std::string placed(const char* tag, int id, const std::string& transform = "1 0 0 0 1 0 0 0 1 0 0 0") {
    return std::string("<") + tag + " objectid=\"" + std::to_string(id) + "\" transform=\"" + transform + "\"/>";
}

}  // namespace kerf::test
