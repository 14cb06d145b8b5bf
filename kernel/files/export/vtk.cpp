// VTK's legacy format, binary, in version 3.0, which programs that know no XML read, too: the grid of merged files of
// vtu (files/export/inside/whole_grid.h), with the same arrays, as field data. Numbers are big endian, and those of
// nodes have 32 bits. Nodes have no array of numbers, as they are in the order of these.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/whole_grid.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace vtk {

constexpr const char* legacy_begin = "# vtk DataFile Version 3.0\n";

// Values of a type: its name, and the bytes of one.
struct LegacyType {
    const char* name;
    std::size_t bytes;
};

LegacyType legacy_type(std::string_view type) {
    if (type == vtk_type<std::uint8_t>) return {"unsigned_char", 1};
    if (type == vtk_type<std::int32_t>) return {"int", 4};
    if (type == vtk_type<float>) return {"float", 4};
    return {"double", 8};
}

// Returns the name as words of the format are: blanks would end it.
std::string encoded(std::string_view name) {
    std::string word;
    for (const unsigned char c : name)
        word += c <= ' ' || c == '%' || c == '"' || c >= 0x7f ? fmt::format("%{:02X}", c) : std::string(1, c);
    return word;
}

void write_values(const VtuArray<ValueFile>& array, ExportFile& file) {
    ValueFile values(file, legacy_type(array.type).bytes);
    array.write_values(values);
    file.write("\n");
}

// Writes the arrays of a section of the XML behind this head, if there are any.
void write_fields(const WholeGrid& grid, std::string_view section, const std::string& head, ExportFile& file) {
    const auto is_field = [section](const VtuArrayHead& array) {
        return array.section == section && array.name != "GlobalVertexId";
    };
    const std::int64_t count = std::count_if(grid.arrays.begin(), grid.arrays.end(), is_field);
    if (count == 0) return;
    file.write(fmt::format("{}FIELD FieldData {}\n", head, count));
    for (const VtuArray<ValueFile>& array : grid.arrays) {
        if (!is_field(array)) continue;
        file.write(fmt::format("{} {} {} {}\n", encoded(array.name), array.components, array.tuples,
                               legacy_type(array.type).name));
        write_values(array, file);
    }
}

void write_points(const WholeGrid& grid, ExportFile& file) {
    file.write(fmt::format("POINTS {} double\n", grid.points));
    for (const VtuArray<ValueFile>& array : grid.arrays)
        if (array.section == std::string_view("Points")) write_values(array, file);
}

void write_cells(const PartSource& parts, ExportFile& file) {
    const MeshOutline& outline = parts.outline();
    const std::int64_t tets = outline.tets(), facets = outline.patch_facets(), cells = tets + facets;
    file.write(fmt::format("CELLS {} {}\n", cells,
                           cells + nodes_of_tets(outline.order) * tets + nodes_of_triangles(outline.order) * facets));
    ValueFile numbers(file, sizeof(std::int32_t));
    for_each_cell(parts, [&](const CellNodes& cell) {
        numbers.value<std::int32_t>(cell.size());
        for (const std::int32_t node : cell) numbers.value(node);
    });
    file.write(fmt::format("\nCELL_TYPES {}\n", cells));
    const CellTypes types = cell_types(outline);
    write_computed<std::int32_t>(numbers, cells,
                                 [&](std::int64_t c) { return c < tets ? types.tetrahedron : types.triangle; });
    file.write("\n");
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "vtk", most_of_32_bits);
    const WholeGrid grid = whole_grid(parts);
    ExportFile file = files.create(stem + ".vtk");
    file.write(std::string(legacy_begin) + "Mesh of Kerf\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
    write_points(grid, file);
    write_cells(parts, file);
    write_fields(grid, "FieldData", "", file);  // some programs expect the points first
    write_fields(grid, "CellData", fmt::format("CELL_DATA {}\n", grid.cells), file);
    write_fields(grid, "PointData", fmt::format("POINT_DATA {}\n", grid.points), file);
    file.close();
}

}  // namespace vtk

extern const Format vtk_format = {
    .name = "vtk",
    .help = "VTK's legacy format: VisIt, meshio, old programs",
    .ending = ".vtk",
    .kind = {"VTK file", [](std::string_view text) { return text.starts_with(vtk::legacy_begin); }},
    .has_values = true,
    .write_merged = vtk::write_merged};

}  // namespace kerf
