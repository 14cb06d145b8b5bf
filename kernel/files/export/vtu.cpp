// VTK XML: a file a part and one that joins them; or, merged, all as one grid. The cells of that are the tetrahedra of
// all parts, then the triangles on patches, for a wall between regions the triangles of one side; for order 2 all of
// them are quadratic. The arrays of the grid have the names and values that they have in part files, which are
// described in files/part/vtu_writer.h.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/whole_mesh.h"
#include "files/io/run_folder.h"
#include "files/io/vtk_cell_types.h"
#include "files/part/appended_vtu.h"
#include "files/part/region_walls.h"
#include "files/part/vtu_writer.h"

namespace kerf {

namespace vtu {

std::string file_of_part(NodeId id) { return "parts/" + part_file_name(id); }

void write_joining_file(const PartSource& parts, ExportFiles& files) {
    std::vector<std::string> pieces;
    for (const PartExtent& part : parts.outline().parts) pieces.push_back(file_of_part(part.id));
    ExportFile file = files.create("mesh.pvtu");
    file.write(pvtu_text(pieces, layout_for(parts.outline(), files.options().fields), parts.outline().values));
    file.close();
}

void write_piece(const PartSource& parts, PartIndex, const Part& part, ExportFiles& files) {
    const std::string name = file_of_part(part.id), path = files.path_of(name);
    const FileHash hash = write_part(path, part, layout_for(parts.outline(), files.options().fields), part.values);
    files.add({name, static_cast<std::int64_t>(std::filesystem::file_size(path)), hash_text(hash)});
}

using Grid = VtuGrid<ExportFile>;
using GridArray = VtuArray<ExportFile>;

void write_parts(const MeshOutline& outline, ExportFile& file) {
    for (const auto count : {&PartExtent::tets, &PartExtent::patch_facets})
        for (const PartExtent& part : outline.parts)
            write_computed<std::int32_t>(file, part.*count, [&](std::int64_t) { return part.id.value(); });
}

// -1 for tetrahedra, then the values of the triangles on patches.
void write_of_facets(const PartSource& parts, std::vector<std::int32_t> Part::*values, ExportFile& file) {
    write_computed<std::int32_t>(file, parts.outline().tets(), [](std::int64_t) { return -1; });
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_listed(f)) file.value((part.*values)[f]);
    });
}

void write_regions(const PartSource& parts, ExportFile& file) {
    for_each_part(parts, PartContent::cells, [&](PartIndex, const Part& part) {
        write_computed<std::int32_t>(file, part.tet_count(), [&](std::int64_t t) { return part.region_of(t).value(); });
    });
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_listed(f)) file.value(region_behind(part, f).value());
    });
}

// The bytes of each name and a zero byte.
template <class Id>
GridArray connectivity(const PartSource& parts) {
    const MeshOutline& outline = parts.outline();
    const std::int64_t nodes =
        nodes_of_tets(outline.order) * outline.tets() + nodes_of_triangles(outline.order) * outline.patch_facets();
    return GridArray::of<Id>("Cells", "connectivity", 1, nodes, [&parts](ExportFile& file) {
        const auto write_cell = [&](const CellNodes& cell) {
            for (const Id id : cell) file.value(id);
        };
        for_each_part(parts, PartContent::cells, [&](PartIndex, const Part& part) {
            for (std::int64_t t = 0; t < part.tet_count(); ++t) write_cell(nodes_of_tet(part, t));
        });
        for_each_part(parts, patch_content(parts.outline()), [&](PartIndex, const Part& part) {
            for (std::size_t f = 0; f < part.facets.size(); ++f)
                if (part.is_listed(f)) write_cell(nodes_of_facet(part, f));
        });
    });
}

// Writes the values of tetrahedra, then of the triangles on patches, which have those of the tetrahedron behind them.
template <class T>
void write_cell_values(const PartSource& parts, std::size_t k, ExportFile& file) {
    const auto write_row = [&](const PartValues& values, std::int32_t tet) {
        for (int i = 0; i < values.components; ++i)
            file.value<T>(tet < 0 ? NAN : values.number(std::int64_t{values.components} * tet + i));
    };
    for_each_part(parts, PartContent::all, [&](PartIndex, const Part& part) {
        for (std::int32_t tet = 0; tet < part.tet_count(); ++tet) write_row(part.values[k], tet);
    });
    for_each_part(parts, PartContent::all, [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_listed(f)) write_row(part.values[k], part.tet_at_facet[f]);
    });
}

template <class T>
void add_values_of(const PartSource& parts, std::size_t k, Grid& grid) {
    const PartValues& values = parts.outline().values[k];
    if (values.of == PartValues::Of::tets)
        return grid.add(GridArray::of<T>("CellData", values.name, values.components, grid.cells,
                                         [&parts, k](ExportFile& file) { write_cell_values<T>(parts, k, file); }));
    grid.add(GridArray::of<T>("PointData", values.name, values.components, grid.points, [&parts, k](ExportFile& file) {
        for_each_node_value(parts, k, [&](std::int64_t, std::span<const double> rows) {
            for (const T number : rows) file.value(number);
        });
    }));
}

// The outline must outlive it.
Grid grid_of(const PartSource& parts) {
    const MeshOutline& outline = parts.outline();
    const std::int64_t tets = outline.tets(), facets = outline.patch_facets(), nodes = outline.nodes();
    const std::int64_t of_tet = nodes_of_tets(outline.order), of_facet = nodes_of_triangles(outline.order);
    const std::uint8_t tet_type = outline.order == 1 ? vtk_tetra : vtk_quadratic_tetra;
    const std::uint8_t facet_type = outline.order == 1 ? vtk_triangle : vtk_quadratic_triangle;
    Grid grid{nodes, tets + facets};
    const auto of_cells = [&](const char* name, std::vector<std::int32_t> Part::*of_facets) {
        return GridArray::of<std::int32_t>("CellData", name, 1, grid.cells, [&parts, of_facets](ExportFile& file) {
            write_of_facets(parts, of_facets, file);
        });
    };
    grid.arrays = {
        names_array<ExportFile>("PatchNames", outline.patch_names),
        GridArray::of<std::int64_t>(
            "PointData", "GlobalVertexId", 1, nodes,
            [=](ExportFile& file) { write_computed<std::int64_t>(file, nodes, [](std::int64_t n) { return n; }); }),
        GridArray::of<std::int32_t>("CellData", "Part", 1, grid.cells,
                                    [&](ExportFile& file) { write_parts(outline, file); }),
        of_cells("Patch", &Part::patch),
        of_cells("Facet", &Part::facet),
        GridArray::of<double>("Points", "Points", 3, nodes,
                              [&](ExportFile& file) {
                                  for_each_node(
                                      parts, [&](std::int64_t, std::span<const Vec3> points) { file.values(points); });
                              }),
        nodes <= most_of_32_bits ? connectivity<std::int32_t>(parts) : connectivity<std::int64_t>(parts),
        GridArray::of<std::int64_t>("Cells", "offsets", 1, grid.cells,
                                    [=](ExportFile& file) {
                                        write_computed<std::int64_t>(file, tets + facets, [=](std::int64_t c) {
                                            const std::int64_t facets_here = std::max<std::int64_t>(0, c + 1 - tets);
                                            return of_tet * (c + 1 - facets_here) + of_facet * facets_here;
                                        });
                                    }),
        GridArray::of<std::uint8_t>("Cells", "types", 1, grid.cells, [=](ExportFile& file) {
            write_computed<std::uint8_t>(file, tets + facets,
                                         [=](std::int64_t c) { return c < tets ? tet_type : facet_type; });
        })};
    if (!outline.region_names.empty()) {
        grid.add(names_array<ExportFile>("RegionNames", outline.region_names));
        grid.add(GridArray::of<std::int32_t>("CellData", "Region", 1, grid.cells,
                                             [&parts](ExportFile& file) { write_regions(parts, file); }));
    }
    for (std::size_t k = 0; k < outline.values.size(); ++k)
        outline.values[k].is_double() ? add_values_of<double>(parts, k, grid) : add_values_of<float>(parts, k, grid);
    return grid;
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    ExportFile file = files.create(stem + ".vtu");
    grid_of(parts).write(file);
    file.close();
}

}  // namespace vtu

extern const Format vtu_format = {.name = "vtu",
                                  .help = "VTK XML: ParaView, meshio, pyvista",
                                  .ending = ".vtu",
                                  .kind = output_kind::vtu,
                                  .asks_for_one_part = true,
                                  .write_whole = vtu::write_joining_file,
                                  .write_part = vtu::write_piece,
                                  .write_merged = vtu::write_merged};

}  // namespace kerf
