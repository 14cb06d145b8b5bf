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

/// How the sizes of files are said: before each of them, or behind it and in the table of contents, as what is written
/// to a stream has them, by 32 bits or by the 64 of ZIP64.
enum class ZipSizes { before, behind, behind_by_64_bits };

/// A ZIP archive of files that are not compressed. `claim`: what its table of contents says more of each than there is.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files, std::size_t claim = 0,
                       ZipSizes sizes = ZipSizes::before) {
    constexpr std::size_t in_zip64 = 0xffffffff;
    const bool is_behind = sizes != ZipSizes::before, is_long = sizes == ZipSizes::behind_by_64_bits;
    const int width = is_long ? 8 : 4;
    std::string bytes, table;
    for (const auto& [name, content] : files) {
        const std::size_t offset = bytes.size();
        const std::size_t sum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), uInt(content.size()));
        const auto append_head = [&](std::string& to, std::size_t crc, std::size_t packed, std::size_t size,
                                     int extra) {
            append_number(to, is_long ? 45 : 20, 2);  // version that is needed
            append_number(to, is_behind ? 8 : 0, 2);  // flags
            append_number(to, 0, 6);                  // not compressed, no time
            append_number(to, crc, 4);
            append_number(to, packed, 4);
            append_number(to, size, 4);
            append_number(to, name.size(), 2);
            append_number(to, static_cast<std::size_t>(extra), 2);
        };
        bytes += "PK\3\4";
        if (is_behind)
            append_head(bytes, 0, 0, 0, 0);
        else
            append_head(bytes, sum, content.size(), content.size(), 0);
        bytes += name + content;
        if (is_behind) {
            bytes += "PK\7\10";
            append_number(bytes, sum, 4);
            append_number(bytes, content.size(), width);
            append_number(bytes, content.size(), width);
        }
        table += "PK\1\2";
        append_number(table, is_long ? 45 : 20, 2);
        if (is_long)
            append_head(table, sum, in_zip64, in_zip64, 28);
        else
            append_head(table, sum, content.size(), content.size() + claim, 0);
        append_number(table, 0, 10);  // no comment, first disk, no attributes
        append_number(table, is_long ? in_zip64 : offset, 4);
        table += name;
        if (!is_long) continue;
        append_number(table, 1, 2);
        append_number(table, 24, 2);
        for (const std::size_t number : {content.size() + claim, content.size(), offset})
            append_number(table, number, 8);
    }
    const std::size_t offset = bytes.size();
    bytes += table;
    if (is_long) {
        const std::size_t end = bytes.size();
        bytes += "PK\6\6";
        append_number(bytes, 44, 8);
        append_number(bytes, 45, 2);
        append_number(bytes, 45, 2);
        append_number(bytes, 0, 8);  // first disk
        for (const std::size_t number : {files.size(), files.size(), table.size(), offset})
            append_number(bytes, number, 8);
        bytes += "PK\6\7";
        append_number(bytes, 0, 4);  // first disk
        append_number(bytes, end, 8);
        append_number(bytes, 1, 4);  // disks
    }
    bytes += "PK\5\6";
    append_number(bytes, 0, 4);  // first disk
    append_number(bytes, is_long ? 0xffff : files.size(), 2);
    append_number(bytes, is_long ? 0xffff : files.size(), 2);
    append_number(bytes, is_long ? in_zip64 : table.size(), 4);
    append_number(bytes, is_long ? in_zip64 : offset, 4);
    append_number(bytes, 0, 2);  // no comment
    return bytes;
}

/// A 3MF file of these resources and build items.
inline std::string threemf(const std::string& resources, const std::string& items,
                           const std::string& unit = "millimeter", std::size_t claim = 0,
                           ZipSizes sizes = ZipSizes::before) {
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
        claim, sizes);
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
