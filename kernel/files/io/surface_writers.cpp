// All files say in their first hundred bytes that they are surfaces of Kerf, so that a later one may replace them
// (files/io/output_kind.h). Both kinds of VTK's files are the same arrays as text, in a frame of their own.
#include "files/io/surface_writers.h"

#include <bit>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "files/io/output_file.h"

namespace kerf {

namespace surface_writers {

void check(const Soup& soup) {
    KERF_CHECK(are_in_range(soup.facets, soup.vertices.size()) && soup.patch.size() == soup.facets.size());
}

// An array as text, a row on each line.
struct TextArray {
    const char *xml_type, *legacy_type;
    std::string name;
    std::size_t size = 0;
    std::string text = {};

    template <class Row>
    void add_row(const Row& row) {
        const char* separator = "";
        for (const auto& value : row) {
            fmt::format_to(std::back_inserter(text), "{}{}", separator, value);
            separator = " ";
            ++size;
        }
        text += '\n';
    }
};

TextArray integers(const char* name) { return {"Int32", "int", name}; }

TextArray points_of(const Soup& soup) {
    TextArray points{"Float64", "double", "Points"};
    for (const Vec3& p : soup.vertices) points.add_row(p);
    return points;
}

// The bytes of names, with a zero byte behind each.
TextArray names_of(const char* name, const std::vector<std::string>& names) {
    TextArray bytes{"UInt8", "unsigned_char", name};
    for (const std::string& each : names) {
        std::vector<int> row(each.size() + 1, 0);
        for (std::size_t i = 0; i < each.size(); ++i) row[i] = static_cast<unsigned char>(each[i]);
        bytes.add_row(row);
    }
    return bytes;
}

std::vector<TextArray> field_arrays(const Soup& soup) {
    std::vector<TextArray> arrays = {names_of("PatchNames", soup.patch_names)};
    if (!soup.sides.empty()) arrays.push_back(names_of("RegionNames", soup.region_names));
    return arrays;
}

std::vector<TextArray> cell_arrays(const Soup& soup) {
    std::vector<TextArray> arrays = {integers("Patch")};
    for (const std::int32_t patch : soup.patch) arrays[0].add_row(std::array{patch});
    if (soup.sides.empty()) return arrays;
    arrays.insert(arrays.end(), {integers("front"), integers("back")});
    for (const FacetSides& sides : soup.sides) {
        arrays[1].add_row(std::array{sides.front.is_valid() ? sides.front.value() : -1});
        arrays[2].add_row(std::array{sides.back.is_valid() ? sides.back.value() : -1});
    }
    return arrays;
}

std::string xml_arrays(const char* section, const std::vector<TextArray>& arrays, int components = 1) {
    std::string xml = fmt::format("<{}>\n", section);
    for (const TextArray& array : arrays)
        xml += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n"
            "{}</DataArray>\n",
            array.xml_type, array.name, components, array.size / components, array.text);
    return xml + fmt::format("</{}>\n", section);
}

std::string legacy_fields(const std::vector<TextArray>& arrays) {
    std::string text = fmt::format("FIELD FieldData {}\n", arrays.size());
    for (const TextArray& array : arrays)
        text += fmt::format("{} 1 {} {}\n{}", array.name, array.size, array.legacy_type, array.text);
    return text;
}

template <class T>
void append(std::string& bytes, const T& value) {
    static_assert(std::endian::native == std::endian::little);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace surface_writers

void write_ply(const std::string& path, const Soup& soup) {
    surface_writers::check(soup);
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment Surface of Kerf\nelement vertex {}\nproperty double x\n"
        "property double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        soup.vertices.size(), soup.facets.size());
    for (const Vec3& p : soup.vertices)
        for (const double x : p) surface_writers::append(bytes, x);
    for (const Triangle& facet : soup.facets) {
        surface_writers::append(bytes, std::uint8_t{3});
        for (const std::int32_t v : facet) surface_writers::append(bytes, v);
    }
    write_output_file(path, bytes);
}

void write_off(const std::string& path, const Soup& soup) {
    surface_writers::check(soup);
    std::string text = fmt::format("OFF\n# Surface of Kerf\n{} {} 0\n", soup.vertices.size(), soup.facets.size());
    text += surface_writers::points_of(soup).text;
    for (const auto& [a, b, c] : soup.facets) fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", a, b, c);
    write_output_file(path, text);
}

std::string vtp_text(const Soup& soup) {
    using namespace surface_writers;
    check(soup);
    TextArray corners = integers("connectivity"), ends = integers("offsets");
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        corners.add_row(soup.facets[f]);
        ends.add_row(std::array{3 * (f + 1)});
    }
    return "<?xml version=\"1.0\"?>\n<!-- Surface of Kerf -->\n"
           "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n" +
           xml_arrays("FieldData", field_arrays(soup)) +
           fmt::format(
               "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
               "NumberOfPolys=\"{}\">\n",
               soup.vertices.size(), soup.facets.size()) +
           xml_arrays("CellData", cell_arrays(soup)) + xml_arrays("Points", {points_of(soup)}, 3) +
           xml_arrays("Polys", {corners, ends}) + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

void write_vtp(const std::string& path, const Soup& soup) { write_output_file(path, vtp_text(soup)); }

void write_vtk(const std::string& path, const Soup& soup) {
    using namespace surface_writers;
    check(soup);
    std::string text = fmt::format(
        "# vtk DataFile Version 3.0\nSurface of Kerf\nASCII\nDATASET POLYDATA\nPOINTS {} double\n{}POLYGONS {} {}\n",
        soup.vertices.size(), points_of(soup).text, soup.facets.size(), 4 * soup.facets.size());
    for (const auto& [a, b, c] : soup.facets) fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", a, b, c);
    text += legacy_fields(field_arrays(soup));
    text += fmt::format("CELL_DATA {}\n", soup.facets.size()) + legacy_fields(cell_arrays(soup));
    write_output_file(path, text);
}

}  // namespace kerf
