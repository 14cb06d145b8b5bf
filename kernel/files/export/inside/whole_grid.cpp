// Arrays are written as they are read off the parts, one part at a time: first what tetrahedra have, then what
// triangles on patches have, in the order of the tree. VTK's XML has values as they lie in memory, its legacy files big
// endian.
#include "files/export/inside/whole_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "files/io/vtk_cell_types.h"
#include "files/part/region_walls.h"

namespace kerf {

void ValueFile::write(const void* data, std::size_t size) {
    if (reversed_ <= 1) return file_.write(data, size);
    std::array<char, 4096> reversed;
    const char* bytes = static_cast<const char*>(data);
    for (std::size_t begin = 0; begin < size; begin += reversed.size()) {
        const std::size_t count = std::min(reversed.size(), size - begin);
        for (std::size_t value = 0; value < count; value += reversed_)
            std::reverse_copy(bytes + begin + value, bytes + begin + value + reversed_, reversed.data() + value);
        file_.write(reversed.data(), count);
    }
}

namespace grid {

using GridArray = VtuArray<ValueFile>;

void write_parts(const MeshOutline& outline, ValueFile& file) {
    for (const auto count : {&PartExtent::tets, &PartExtent::patch_facets})
        for (const PartExtent& part : outline.parts)
            write_computed<std::int32_t>(file, part.*count, [&](std::int64_t) { return part.id.value(); });
}

// -1 for tetrahedra, then the values of the triangles on patches.
void write_of_facets(const PartSource& parts, std::vector<std::int32_t> Part::*values, ValueFile& file) {
    write_computed<std::int32_t>(file, parts.outline().tets(), [](std::int64_t) { return -1; });
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for_each_listed_facet(part, [&](std::size_t f) { file.value((part.*values)[f]); });
    });
}

void write_regions(const PartSource& parts, ValueFile& file) {
    for_each_part(parts, PartContent::cells, [&](PartIndex, const Part& part) {
        write_computed<std::int32_t>(file, part.tet_count(), [&](std::int64_t t) { return part.region_of(t).value(); });
    });
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for_each_listed_facet(part, [&](std::size_t f) { file.value(region_behind(part, f).value()); });
    });
}

template <class Id>
GridArray connectivity(const PartSource& parts) {
    const MeshOutline& outline = parts.outline();
    const std::int64_t nodes =
        nodes_of_tets(outline.order) * outline.tets() + nodes_of_triangles(outline.order) * outline.patch_facets();
    return GridArray::of<Id>("Cells", "connectivity", 1, nodes, [&parts](ValueFile& file) {
        for_each_cell(parts, [&](const CellNodes& cell) {
            for (const Id id : cell) file.value(id);
        });
    });
}

// Writes the values of tetrahedra, then of the triangles on patches, which have those of the tetrahedron behind them.
template <class T>
void write_cell_values(const PartSource& parts, std::size_t k, ValueFile& file) {
    const auto write_row = [&](const PartValues& values, std::int32_t tet) {
        for (int i = 0; i < values.components; ++i)
            file.value<T>(tet < 0 ? NAN : values.number(std::int64_t{values.components} * tet + i));
    };
    for_each_part(parts, PartContent::all, [&](PartIndex, const Part& part) {
        for (std::int32_t tet = 0; tet < part.tet_count(); ++tet) write_row(part.values[k], tet);
    });
    for_each_part(parts, PartContent::all, [&](PartIndex, const Part& part) {
        for_each_listed_facet(part, [&](std::size_t f) { write_row(part.values[k], part.tet_at_facet[f]); });
    });
}

template <class T>
void add_values_of(const PartSource& parts, std::size_t k, WholeGrid& grid) {
    const PartValues& values = parts.outline().values[k];
    if (values.of == PartValues::Of::tets)
        return grid.add(GridArray::of<T>("CellData", values.name, values.components, grid.cells,
                                         [&parts, k](ValueFile& file) { write_cell_values<T>(parts, k, file); }));
    grid.add(GridArray::of<T>("PointData", values.name, values.components, grid.points, [&parts, k](ValueFile& file) {
        for_each_node_value(parts, k, [&](std::int64_t, std::span<const double> rows) {
            for (const T number : rows) file.value(number);
        });
    }));
}

}  // namespace grid

void for_each_cell(const PartSource& parts, const std::function<void(const CellNodes& cell)>& take) {
    for_each_part(parts, PartContent::cells, [&](PartIndex, const Part& part) {
        for (std::int64_t t = 0; t < part.tet_count(); ++t) take(nodes_of_tet(part, t));
    });
    for_each_part(parts, patch_content(parts.outline()), [&](PartIndex, const Part& part) {
        for_each_listed_facet(part, [&](std::size_t f) { take(nodes_of_facet(part, f)); });
    });
}

CellTypes cell_types(const MeshOutline& outline) {
    return outline.order == 1 ? CellTypes{vtk_tetra, vtk_triangle}
                              : CellTypes{vtk_quadratic_tetra, vtk_quadratic_triangle};
}

WholeGrid whole_grid(const PartSource& parts) {
    const MeshOutline& outline = parts.outline();
    const std::int64_t tets = outline.tets(), facets = outline.patch_facets(), nodes = outline.nodes();
    const std::int64_t of_tet = nodes_of_tets(outline.order), of_facet = nodes_of_triangles(outline.order);
    const CellTypes types = cell_types(outline);
    WholeGrid whole{nodes, tets + facets};
    const auto of_cells = [&](const char* name, std::vector<std::int32_t> Part::*of_facets) {
        return grid::GridArray::of<std::int32_t>(
            "CellData", name, 1, whole.cells,
            [&parts, of_facets](ValueFile& file) { grid::write_of_facets(parts, of_facets, file); });
    };
    whole.arrays = {
        names_array<ValueFile>("PatchNames", outline.patch_names),
        grid::GridArray::of<std::int64_t>(
            "PointData", "GlobalVertexId", 1, nodes,
            [=](ValueFile& file) { write_computed<std::int64_t>(file, nodes, [](std::int64_t n) { return n; }); }),
        grid::GridArray::of<std::int32_t>("CellData", "Part", 1, whole.cells,
                                          [&](ValueFile& file) { grid::write_parts(outline, file); }),
        of_cells("Patch", &Part::patch),
        of_cells("Facet", &Part::facet),
        grid::GridArray::of<double>("Points", "Points", 3, nodes,
                                    [&](ValueFile& file) {
                                        for_each_node(parts, [&](std::int64_t, std::span<const Vec3> points) {
                                            file.values(points);
                                        });
                                    }),
        nodes <= most_of_32_bits ? grid::connectivity<std::int32_t>(parts) : grid::connectivity<std::int64_t>(parts),
        grid::GridArray::of<std::int64_t>("Cells", "offsets", 1, whole.cells,
                                          [=](ValueFile& file) {
                                              write_computed<std::int64_t>(file, tets + facets, [=](std::int64_t c) {
                                                  const std::int64_t facets_here =
                                                      std::max<std::int64_t>(0, c + 1 - tets);
                                                  return of_tet * (c + 1 - facets_here) + of_facet * facets_here;
                                              });
                                          }),
        grid::GridArray::of<std::uint8_t>("Cells", "types", 1, whole.cells, [=](ValueFile& file) {
            write_computed<std::uint8_t>(file, tets + facets,
                                         [=](std::int64_t c) { return c < tets ? types.tetrahedron : types.triangle; });
        })};
    if (!outline.region_names.empty()) {
        whole.add(names_array<ValueFile>("RegionNames", outline.region_names));
        whole.add(grid::GridArray::of<std::int32_t>("CellData", "Region", 1, whole.cells,
                                                    [&parts](ValueFile& file) { grid::write_regions(parts, file); }));
    }
    for (std::size_t k = 0; k < outline.values.size(); ++k)
        outline.values[k].is_double() ? grid::add_values_of<double>(parts, k, whole)
                                      : grid::add_values_of<float>(parts, k, whole);
    return whole;
}

}  // namespace kerf
