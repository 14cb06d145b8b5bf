// VTK XML: a file a part and one that joins them; or all as one grid, whose cells are the tetrahedra of all parts, then
// the triangles on patches. The arrays of the grid have the names and values that they have in part files, which are
// described in part/vtu_writer.h; they follow the XML as raw bytes, each behind its size.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "export/format.h"
#include "export/whole_mesh.h"
#include "io/run_folder.h"
#include "io/vtk_cell_types.h"
#include "part/vtu_writer.h"

namespace kerf {

namespace vtu {

std::string file_of_part(NodeId id) { return "parts/" + part_file_name(id); }

void write_joining_file(const PartSource& parts, ExportFiles& files) {
    std::vector<std::string> pieces;
    for (const PartExtent& part : parts.outline().parts) pieces.push_back(file_of_part(part.id));
    ExportFile file = files.create("mesh.pvtu");
    file.text(pvtu_text(pieces, layout_for(parts.outline(), files.options().fields), parts.outline().values));
    file.close();
}

void write_piece(const PartSource& parts, std::int32_t, const Part& part, ExportFiles& files) {
    const std::string name = file_of_part(part.id), path = files.path_of(name);
    const FileHash hash = write_part(path, part, layout_for(parts.outline(), files.options().fields), part.values);
    files.add({name, static_cast<std::int64_t>(std::filesystem::file_size(path)), hash_text(hash)});
}

struct GridArray {
    const char* section;  // element of the XML
    const char* type;
    std::string name;
    int components;
    std::int64_t tuples;
    std::int64_t item_size;
    std::function<void(ExportFile&)> write_values;

    std::int64_t bytes() const { return components * tuples * item_size; }
};

// value(0), value(1), ...
template <class T, class Value>
void write_computed(ExportFile& file, std::int64_t count, const Value& value) {
    constexpr std::int64_t at_once = std::int64_t{1} << 16;
    std::vector<T> values(static_cast<std::size_t>(std::min(count, at_once)));
    for (std::int64_t begin = 0; begin < count; begin += at_once) {
        const std::int64_t size = std::min(at_once, count - begin);
        for (std::int64_t i = 0; i < size; ++i) values[static_cast<std::size_t>(i)] = static_cast<T>(value(begin + i));
        file.values(std::span<const T>(values).first(static_cast<std::size_t>(size)));
    }
}

void write_names(const MeshOutline& outline, ExportFile& file) {
    for (const std::string& name : outline.patch_names) file.bytes(name.c_str(), name.size() + 1);
}

void write_points(const PartSource& parts, ExportFile& file) {
    for_each_vertex(parts, [&](std::int64_t, std::span<const Vec3> points) { file.values(points); });
}

void write_parts(const MeshOutline& outline, ExportFile& file) {
    for (const auto count : {&PartExtent::tets, &PartExtent::patch_facets})
        for (const PartExtent& part : outline.parts)
            write_computed<std::int32_t>(file, part.*count, [&](std::int64_t) { return part.id; });
}

// -1 for tetrahedra, then the values of the triangles on patches.
void write_of_facets(const PartSource& parts, std::vector<std::int32_t> Part::*values, ExportFile& file) {
    write_computed<std::int32_t>(file, parts.outline().tets(), [](std::int64_t) { return -1; });
    for_each_surface(parts, [&](std::int32_t, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (!part.is_interface(f)) file.value((part.*values)[f]);
    });
}

template <class Id>
void write_connectivity(const PartSource& parts, ExportFile& file) {
    const auto write_cell = [&](const Part& part, const auto& cell) {
        for (const std::int64_t id : global_corners(part, cell)) file.value(static_cast<Id>(id));
    };
    for_each_part(parts, [&](std::int32_t, const Part& part) {
        for (const Tetrahedron& tet : part.mesh.tets) write_cell(part, tet);
    });
    for_each_surface(parts, [&](std::int32_t, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (!part.is_interface(f)) write_cell(part, part.facets[f]);
    });
}

void write_number(const PartValues& values, double number, ExportFile& file) {
    values.is_double() ? file.value(number) : file.value(static_cast<float>(number));
}

// Of tetrahedra, then of the triangles on patches, which have those of the tetrahedron behind them.
void write_cell_values(const PartSource& parts, std::size_t k, ExportFile& file) {
    const auto write_row = [&](const PartValues& values, std::int32_t tet) {
        for (int i = 0; i < values.components; ++i)
            write_number(values, tet < 0 ? NAN : values.number(static_cast<std::size_t>(values.components * tet + i)),
                         file);
    };
    for_each_whole_part(parts, [&](std::int32_t, const Part& part) {
        for (std::int32_t tet = 0; tet < part.tet_count(); ++tet) write_row(part.values[k], tet);
    });
    for_each_whole_part(parts, [&](std::int32_t, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (!part.is_interface(f)) write_row(part.values[k], part.tet_at_facet[f]);
    });
}

// Behind the other arrays of their section.
void add_values(const PartSource& parts, std::vector<GridArray>& arrays) {
    const MeshOutline& outline = parts.outline();
    for (std::size_t k = 0; k < outline.values.size(); ++k) {
        const PartValues& values = outline.values[k];
        const bool of_points = values.of == PartValues::Of::points;
        const char* const section = of_points ? "PointData" : "CellData";
        const auto write = [&parts, &values, k, of_points](ExportFile& file) {
            if (!of_points) return write_cell_values(parts, k, file);
            for_each_vertex_value(parts, k, [&](std::int64_t, std::span<const double> rows) {
                for (const double number : rows) write_number(values, number, file);
            });
        };
        const auto behind = std::find_if(arrays.rbegin(), arrays.rend(), [section](const GridArray& array) {
            return std::string_view(array.section) == section;
        });
        arrays.insert(behind.base(),
                      {section, values.is_double() ? "Float64" : "Float32", values.name, values.components,
                       of_points ? outline.vertices : outline.tets() + outline.patch_facets(),
                       values.is_double() ? 8 : 4, write});
    }
}

// In the order of the file. The outline must outlive them.
std::vector<GridArray> arrays_of(const PartSource& parts) {
    const MeshOutline& outline = parts.outline();
    const std::int64_t tets = outline.tets(), facets = outline.patch_facets(), cells = tets + facets;
    std::int64_t name_bytes = 0;
    for (const std::string& name : outline.patch_names) name_bytes += static_cast<std::int64_t>(name.size()) + 1;
    const bool is_small = outline.vertices <= most_of_32_bits;
    std::vector<GridArray> arrays = {
        {"FieldData", "UInt8", "PatchNames", 1, name_bytes, 1, [&](ExportFile& file) { write_names(outline, file); }},
        {"PointData", "Int64", "GlobalVertexId", 1, outline.vertices, 8,
         [&](ExportFile& file) {
             write_computed<std::int64_t>(file, outline.vertices, [](std::int64_t v) { return v; });
         }},
        {"CellData", "Int32", "Part", 1, cells, 4, [&](ExportFile& file) { write_parts(outline, file); }},
        {"CellData", "Int32", "Patch", 1, cells, 4,
         [&](ExportFile& file) { write_of_facets(parts, &Part::patch, file); }},
        {"CellData", "Int32", "Facet", 1, cells, 4,
         [&](ExportFile& file) { write_of_facets(parts, &Part::facet, file); }},
        {"Points", "Float64", "Points", 3, outline.vertices, 8, [&](ExportFile& file) { write_points(parts, file); }},
        {"Cells", is_small ? "Int32" : "Int64", "connectivity", 1, 4 * tets + 3 * facets, is_small ? 4 : 8,
         [&, is_small](ExportFile& file) {
             is_small ? write_connectivity<std::int32_t>(parts, file) : write_connectivity<std::int64_t>(parts, file);
         }},
        {"Cells", "Int64", "offsets", 1, cells, 8,
         [=](ExportFile& file) {
             write_computed<std::int64_t>(
                 file, cells, [=](std::int64_t c) { return 4 * (c + 1) - std::max<std::int64_t>(0, c + 1 - tets); });
         }},
        {"Cells", "UInt8", "types", 1, cells, 1,
         [=](ExportFile& file) {
             write_computed<std::uint8_t>(file, cells,
                                          [=](std::int64_t c) { return c < tets ? vtk_tetra : vtk_triangle; });
         }},
    };
    add_values(parts, arrays);
    return arrays;
}

std::string head_of(const MeshOutline& outline, std::span<const GridArray> arrays) {
    std::string xml =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "<UnstructuredGrid>\n";
    std::int64_t offset = 0;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        const GridArray& array = arrays[i];
        const std::string_view section = array.section;
        if (i == 0 || section != arrays[i - 1].section) xml += fmt::format("<{}>\n", section);
        xml += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            array.type, array.name, array.components, array.tuples, offset);
        if (i + 1 == arrays.size() || section != arrays[i + 1].section) xml += fmt::format("</{}>\n", section);
        if (i == 0)
            xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", outline.vertices,
                               outline.tets() + outline.patch_facets());
        offset += static_cast<std::int64_t>(sizeof(std::uint64_t)) + array.bytes();
    }
    return xml + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    const std::vector<GridArray> arrays = arrays_of(parts);
    ExportFile file = files.create(stem + ".vtu");
    file.text(head_of(parts.outline(), arrays));
    for (const GridArray& array : arrays) {
        file.value(static_cast<std::uint64_t>(array.bytes()));
        array.write_values(file);
    }
    file.text("\n</AppendedData>\n</VTKFile>\n");
    file.close();
}

}  // namespace vtu

extern const Format vtu_format = {.name = "vtu",
                                  .help = "VTK XML: ParaView, meshio, pyvista",
                                  .ending = ".vtu",
                                  .asks_for_one_part = true,
                                  .write_whole = vtu::write_joining_file,
                                  .write_part = vtu::write_piece,
                                  .write_merged = vtu::write_merged};

}  // namespace kerf
