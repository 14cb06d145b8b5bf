// pugixml parses the file up to its appended data, which may be raw bytes and so no XML: the text is cut off behind the
// underscore with which they begin, and the elements around them stay open. So do those of a file that is truncated
// between two tags; what it lacks is told by who needs it. Values are not copied: pugixml has texts where they stand in
// the bytes, so that the place of an array in its copy is the place in the file.
#include "files/io/inside/vtu_structure.h"

#include <algorithm>
#include <new>
#include <tuple>

#include <pugixml.hpp>

#include "base/core/error.h"
#include "files/io/inside/image_formats.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/vtk_cell_types.h"

namespace kerf::vtu {

namespace {

[[noreturn]] void fail_open_tag(const std::string& path) {
    fail(path, "a tag does not end. The file is truncated: save or copy it again.");
}

// Returns the place behind the underscore of the appended data; that of the end if there are none.
std::size_t find_appended(std::string_view bytes, const std::string& path) {
    const std::size_t tag = bytes.find("<AppendedData");
    if (tag == bytes.npos) return bytes.size();
    const std::size_t tag_end = bytes.find('>', tag);
    if (tag_end == bytes.npos) fail_open_tag(path);
    const std::size_t underscore = bytes.find('_', tag_end);
    if (underscore == bytes.npos) fail(path, "its appended data are missing. The file is truncated: copy it again.");
    return underscore + 1;
}

// Elements may be open at the end of the text.
void check_parsed(const pugi::xml_parse_result& result, std::string_view text, const std::string& path) {
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    const std::size_t place = result.offset;
    const bool is_open = result.status == pugi::status_end_element_mismatch && place + 1 >= text.size();
    if (result || is_open) return;
    if (text.find('>', place) == text.npos) fail_open_tag(path);
    fail(path, "its XML is damaged at byte " + std::to_string(place) + ". Save or copy it again.");
}

void read_root(const pugi::xml_node& root, File& file, const std::string& path) {
    const std::string_view type = root.attribute("type").value();
    if (type == "PUnstructuredGrid" || type == "PPolyData")
        fail(path, "this is a list of parts. Name the folder of the run or one of the parts.");
    if (type == "ImageData" || type == "PImageData") fail(path, image_refusal("an image of VTK"));
    if (type != "UnstructuredGrid" && type != "PolyData")
        fail(path, "VTK's " + std::string(type.substr(0, 40)) +
                       " is no surface and no mesh of tetrahedra. Save it as a surface (.vtp) or an unstructured grid "
                       "(.vtu).");
    file.has_long_headers = root.attribute("header_type").value() == std::string_view("UInt64");
    file.order =
        root.attribute("byte_order").value() == std::string_view("BigEndian") ? std::endian::big : std::endian::little;
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail(path, "the compression " + std::string(compressor.substr(0, 40)) +
                       " cannot be read. Save it with vtkZLibDataCompressor or without one.");
    file.is_compressed = !compressor.empty();
    file.is_appended_base64 = root.child("AppendedData").attribute("encoding").value() != std::string_view("raw");
}

std::int64_t count_in(const pugi::xml_node& element, const char* attribute, const std::string& path) {
    const std::string_view text = element.attribute(attribute).value();
    TextScanner scanner(text, path);
    constexpr std::int64_t most = std::int64_t{1} << 60;  // three times as many are still a number
    const std::int64_t count = text.empty() ? 0 : scanner.next_count();
    if (count > most) fail(path, "it claims " + std::to_string(count) + " elements. Save it again.");
    return count;
}

// Reads an array whose values, if they stand in the element, are a part of `text`.
Array read_array(const pugi::xml_node& element, std::string_view text, const std::string& path) {
    Array array{element.attribute("type").value(),
                element.attribute("format").as_string("ascii"),
                {},
                count_in(element, "offset", path)};
    if (array.format.empty()) array.format = "ascii";
    if (const pugi::xml_node values = element.text().data()) {
        const std::string_view rest = text.substr(values.offset_debug());
        array.content = rest.substr(0, rest.find('<'));
    }
    return array;
}

bool is_scalar(const pugi::xml_node& array) {
    const std::string_view components = array.attribute("NumberOfComponents").value();
    return components.empty() || components == "1";
}

// Calls take(name, array) for the arrays of a section of the grid or of a piece, in their order.
template <class Take>
void for_each_array(const pugi::xml_node& around, const char* section, const Take& take) {
    for (const pugi::xml_node& arrays : around.children(section))
        for (const pugi::xml_node& array : arrays.children())
            if (const std::string_view element = array.name(); element == "DataArray" || element == "Array")
                take(std::string(array.attribute("Name").value()), array);
}

// Reads the lists of cells of a surface, in the order in which its cells are counted.
void read_lists(const pugi::xml_node& element, std::string_view text, const std::string& path, Piece& piece) {
    for (const auto& [list, number, type] : {std::tuple{"Verts", "NumberOfVerts", vtk_poly_vertex},
                                             {"Lines", "NumberOfLines", vtk_poly_line},
                                             {"Polys", "NumberOfPolys", vtk_polygon},
                                             {"Strips", "NumberOfStrips", vtk_triangle_strip}}) {
        const CellList cells{list, type, count_in(element, number, path)};
        for_each_array(element, list, [&](const std::string& name, const pugi::xml_node& array) {
            piece.arrays.try_emplace(cells.element + "/" + name, read_array(array, text, path));
        });
        piece.cells += cells.cells;
        piece.lists.push_back(cells);
    }
}

// Of arrays of one name the first counts.
Piece read_piece(const pugi::xml_node& element, std::string_view text, const std::string& path) {
    Piece piece;
    piece.points = count_in(element, "NumberOfPoints", path);
    piece.cells = count_in(element, "NumberOfCells", path);
    for_each_array(element, "Points", [&](const std::string&, const pugi::xml_node& array) {
        piece.arrays.try_emplace("Points", read_array(array, text, path));
    });
    for_each_array(element, "Cells", [&](const std::string& name, const pugi::xml_node& array) {
        piece.arrays.try_emplace(name, read_array(array, text, path));
    });
    for_each_array(element, "CellData", [&](const std::string& name, const pugi::xml_node& array) {
        const std::string_view type = array.attribute("type").value();
        const bool is_integer = type.starts_with("Int") || type.starts_with("UInt");
        const std::string known = is_scalar(array) ? cell_array_of(name, is_integer) : "";
        if (!known.empty()) piece.arrays.try_emplace(known, read_array(array, text, path));
    });
    for_each_array(element, "PointData", [&](const std::string& name, const pugi::xml_node& array) {
        if (is_scalar(array)) piece.scalars.try_emplace(name, read_array(array, text, path));
    });
    return piece;
}

}  // namespace

File read_structure(std::string_view bytes, const std::string& path) {
    const std::size_t appended = find_appended(bytes, path);
    const std::string_view text = bytes.substr(0, appended);
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(text.data(), text.size(), pugi::parse_escapes, pugi::encoding_utf8);
    const pugi::xml_node root = document.first_child();
    if (root.name() != std::string_view("VTKFile")) fail(path, "it does not begin as a VTK file. Save it as .vtu.");
    check_parsed(result, text, path);
    File file;
    read_root(root, file, path);
    file.appended = bytes.substr(appended);
    const pugi::xml_node grid = root.child(root.attribute("type").value());
    for_each_array(grid, "FieldData", [&](const std::string& name, const pugi::xml_node& array) {
        if (std::find(name_arrays.begin(), name_arrays.end(), name) != name_arrays.end())
            file.fields[name] = read_array(array, text, path);
    });
    for (const pugi::xml_node& element : grid.children("Piece")) {
        file.pieces.push_back(read_piece(element, text, path));
        if (grid.name() == std::string_view("PolyData")) read_lists(element, text, path, file.pieces.back());
    }
    return file;
}

}  // namespace kerf::vtu
