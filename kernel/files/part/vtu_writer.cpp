// The grid of a part is a table of arrays (files/part/appended_vtu.h), each with a function that streams its values, so
// that no array of a mesh is copied; sizes are known before, and the XML is written first. The cells are the
// tetrahedra, then the boundary triangles; a grid without tetrahedra is a part's surface. All measures of quality of a
// cell are computed together when the first array of them is written; all but that one wait as a whole until it is
// their turn, one float a cell each. The order of the arrays is a part of the format: readers know the values of a
// solution by the arrays that they follow.
#include "files/part/vtu_writer.h"

#include <limits>
#include <memory>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/checked_file.h"
#include "files/io/text_file.h"
#include "files/io/vtk_cell_types.h"
#include "files/part/appended_vtu.h"

namespace kerf {

namespace {

using Grid = VtuGrid<CheckedFile>;

void require_sizes(bool sizes_agree) {
    if (!sizes_agree) throw Error(ErrorCode::internal, "The arrays of a part do not have the sizes of its mesh.");
}

// Makes the grid of a part, or of its surface. The part must outlive the grid, whose arrays are written once, in order.
class GridMaker {
 public:
    GridMaker(const Part& part, bool with_cells)
        : part_(part),
          tets_(with_cells ? part.mesh.tets : no_tets),
          edge_nodes_(with_cells ? part.edge_nodes : no_edge_nodes),
          is_quadratic_(with_cells && part.order() == 2) {
        const std::int64_t boundary = part.mesh.boundary_vertex_count;
        vertices_ = with_cells ? part.vertex_count() : boundary;
        points_ = vertices_ + std::ssize(edge_nodes_.global_id);
        tet_count_ = std::ssize(tets_);
        facet_count_ = std::ssize(part.facets);
        grid_.points = points_;
        grid_.cells = tet_count_ + facet_count_;
        grid_.fields = number_field(vtk_type<std::int32_t>, "BoundaryVertexCount", boundary);
        if (is_quadratic_) grid_.fields += number_field(vtk_type<std::int32_t>, "VertexCount", vertices_);
        require_sizes(boundary <= vertices_ && part.global_id.size() == part.mesh.vertices.size() &&
                      edge_nodes_.points.size() == edge_nodes_.edges.size() &&
                      edge_nodes_.global_id.size() == edge_nodes_.edges.size() &&
                      part.neighbour.size() == part.facets.size() && part.patch.size() == part.facets.size() &&
                      part.facet.size() == part.facets.size());
    }

    /// Makes the grid with the qualities of cells and with values.
    Grid part_grid(const VtuLayout& layout, std::span<const PartValues> values) {
        require_sizes(part_.tet_at_facet.size() == part_.facets.size());
        add_names("PatchNames", "PatchNumbers", part_.patch_names);
        if (layout.has_regions) add_names("RegionNames", "RegionNumbers", part_.region_names);
        add_contacts();
        add_array<std::int32_t>("FieldData", "Facet", 1, part_.facet);  // each tetrahedron has none
        add_global_ids();
        add_part(layout.tag_bytes);
        add_tags(layout.tag_bytes, "Patch", part_.patch);
        add_neighbours(layout.tag_bytes);
        if (layout.has_regions) add_regions(layout.tag_bytes);
        add_quality(layout.fields);
        add_points();
        const bool is_short =
            nodes_of_tet() * tet_count_ + nodes_of_facet() * facet_count_ <= std::numeric_limits<std::int32_t>::max();
        is_short ? add_cells<std::int32_t>() : add_cells<std::int64_t>();
        for (const PartValues& each : values)
            std::visit([&](const auto& numbers) { add_values(each, numbers); }, each.numbers);
        return std::move(grid_);
    }

    Grid surface_grid() {
        add_names("PatchNames", "PatchNumbers", part_.patch_names);
        if (!part_.region_names.empty()) add_names("RegionNames", "RegionNumbers", part_.region_names);
        add_contacts();
        add_global_ids();
        add_part(sizeof(std::int32_t));
        add_tags(sizeof(std::int32_t), "Patch", part_.patch);
        add_tags(sizeof(std::int32_t), "Facet", part_.facet);
        add_neighbours(sizeof(std::int32_t));
        if (!part_.region_names.empty()) add_regions(sizeof(std::int32_t));
        add_points();
        add_cells<std::int64_t>();
        return std::move(grid_);
    }

 private:
    template <class T>
    void add(const char* section, std::string name, std::int64_t components, std::int64_t tuples,
             std::function<void(CheckedFile&)> write_values) {
        grid_.arrays.push_back(
            VtuArray<CheckedFile>::of<T>(section, std::move(name), components, tuples, std::move(write_values)));
    }

    // Adds numbers of the type T as they lie in memory.
    template <class T, class Item>
    void add_array(const char* section, std::string name, std::int64_t components, std::span<const Item> items) {
        add<T>(section, std::move(name), components, items.size_bytes() / (components * sizeof(T)),
               [items](CheckedFile& file) { file.write(items.data(), items.size_bytes()); });
    }
    template <class T>
    void add_array(const char* section, std::string name, std::int64_t components, const std::vector<T>& numbers) {
        add_array<T>(section, std::move(name), components, std::span(numbers));
    }

    void add_names(const char* array, const char* numbers, const NameTable& names) {
        grid_.arrays.push_back(names_array<CheckedFile>(array, names.names()));
        if (!names.is_whole()) add_array<std::int32_t>("FieldData", numbers, 1, names.numbers());
    }

    // Most parts have none, and then no arrays either.
    void add_contacts() {
        if (part_.contact_vertices.empty()) return;
        add_array<std::int32_t>("FieldData", "ContactVertices", 1, part_.contact_vertices);
        add_array<std::int32_t>("FieldData", "ContactEdges", 2, std::span(part_.contact_edges));
    }

    void add_global_ids() {
        add_of_nodes<std::int64_t>("PointData", "GlobalVertexId", 1, std::span(part_.global_id).first(vertices_),
                                   std::span(edge_nodes_.global_id));
    }

    void add_points() {
        static_assert(sizeof(Vec3) == 3 * sizeof(double));
        add_of_nodes<double>("Points", "Points", 3, std::span(part_.mesh.vertices).first(vertices_),
                             std::span(edge_nodes_.points));
    }

    // Adds the numbers of the vertices, then those of the nodes on edges.
    template <class T, class Item>
    void add_of_nodes(const char* section, std::string name, std::int64_t components, std::span<const Item> of_vertices,
                      std::span<const Item> of_edges) {
        add<T>(section, std::move(name), components, points_, [of_vertices, of_edges](CheckedFile& file) {
            file.write(of_vertices.data(), of_vertices.size_bytes());
            file.write(of_edges.data(), of_edges.size_bytes());
        });
    }

    // Adds an array with one value a cell: of_tet(t) for the tetrahedra, then of_facet(f).
    template <class T, class OfTet, class OfFacet>
    void add_of_cells(const char* section, std::string name, OfTet of_tet, OfFacet of_facet) {
        add<T>(section, std::move(name), 1, grid_.cells,
               [of_tet, of_facet, tets = tet_count_, facets = facet_count_](CheckedFile& file) {
                   write_computed<T>(file, tets, of_tet);
                   write_computed<T>(file, facets, of_facet);
               });
    }

    void add_part(int bytes) {
        const auto of_all = [id = part_.id.value()](std::int64_t) { return id; };
        add_integers(bytes, "Part", of_all, of_all);
    }

    // Integers of facets; tetrahedra have -1.
    template <class OfFacet>
    void add_of_facets(int bytes, const char* name, OfFacet of_facet) {
        add_integers(
            bytes, name, [](std::int64_t) { return -1; }, of_facet);
    }
    void add_tags(int bytes, const char* name, const std::vector<std::int32_t>& tags) {
        add_of_facets(bytes, name, [&tags](std::int64_t f) { return tags[f]; });
    }
    void add_neighbours(int bytes) {
        add_of_facets(bytes, "Neighbour", [&part = part_](std::int64_t f) { return part.neighbour[f].value(); });
    }

    // Triangles have the values of the tetrahedra behind them.
    void add_regions(int bytes) {
        const auto of_tet = [&part = part_](std::int64_t t) { return part.region_of(t).value(); };
        add_integers(bytes, "Region", of_tet, [&part = part_](std::int64_t f) {
            return part.region_of(std::max(0, part.tet_at_facet[f])).value();
        });
    }

    // Adds integers of so many bytes.
    template <class OfTet, class OfFacet>
    void add_integers(int bytes, const char* name, OfTet of_tet, OfFacet of_facet) {
        if (bytes == 1) return add_of_cells<std::int8_t>("CellData", name, of_tet, of_facet);
        if (bytes == 2) return add_of_cells<std::int16_t>("CellData", name, of_tet, of_facet);
        add_of_cells<std::int32_t>("CellData", name, of_tet, of_facet);
    }

    // All measures of a cell are computed together, when the first array is written; the others wait until it is their
    // turn.
    void add_quality(CellFieldSet fields) {
        const auto waiting = std::make_shared<std::vector<std::vector<float>>>(fields.count());
        const auto write_first = [&part = part_, waiting, cells = grid_.cells, fields](CheckedFile& file) {
            for (std::size_t column = 1; column < waiting->size(); ++column) (*waiting)[column].resize(cells);
            for_all_cell_fields(part, fields,
                                [&](std::size_t column, std::int64_t first, std::span<const float> values) {
                                    if (column == 0) return file.write(values.data(), values.size_bytes());
                                    std::copy(values.begin(), values.end(), (*waiting)[column].begin() + first);
                                });
        };
        std::size_t column = 0;
        for (std::size_t field = 0; field < cell_fields.size(); ++field) {
            if (!fields[field]) continue;
            const auto write_waiting = [waiting, column](CheckedFile& file) {
                const std::vector<float> values = std::move((*waiting)[column]);
                file.write(values.data(), values.size() * sizeof(float));
            };
            add<float>("CellData", cell_fields[field].array, 1, grid_.cells, write_waiting);
            if (column++ == 0) grid_.arrays.back().write_values = write_first;
        }
    }

    std::int64_t nodes_of_tet() const { return is_quadratic_ ? 10 : 4; }
    std::int64_t nodes_of_facet() const { return is_quadratic_ ? 6 : 3; }

    // `Offset`: the type of the places where the nodes of each cell end in the connectivity.
    template <class Offset>
    void add_cells() {
        const std::int64_t of_tet = nodes_of_tet(), of_facet = nodes_of_facet();
        add<std::int32_t>("Cells", "connectivity", 1, of_tet * tet_count_ + of_facet * facet_count_,
                          is_quadratic_ ? quadratic_connectivity() : linear_connectivity());
        add_of_cells<Offset>(
            "Cells", "offsets", [of_tet](std::int64_t t) { return of_tet * (t + 1); },
            [before = of_tet * tet_count_, of_facet](std::int64_t f) { return before + of_facet * (f + 1); });
        add_of_cells<std::uint8_t>(
            "Cells", "types", [type = is_quadratic_ ? vtk_quadratic_tetra : vtk_tetra](std::int64_t) { return type; },
            [type = is_quadratic_ ? vtk_quadratic_triangle : vtk_triangle](std::int64_t) { return type; });
    }
    std::function<void(CheckedFile&)> linear_connectivity() const {
        return [&tets = tets_, &facets = part_.facets](CheckedFile& file) {
            file.write(tets.data(), tets.size() * sizeof(Tetrahedron));
            file.write(facets.data(), facets.size() * sizeof(Triangle));
        };
    }
    std::function<void(CheckedFile&)> quadratic_connectivity() const {
        return [&part = part_, tets = tet_count_, facets = facet_count_](CheckedFile& file) {
            write_computed<std::array<std::int32_t, 10>>(file, tets,
                                                         [&](std::int64_t t) { return part.nodes_of_tet(t); });
            write_computed<std::array<std::int32_t, 6>>(file, facets,
                                                        [&](std::int64_t f) { return part.nodes_of_facet(f); });
        };
    }

    // Adds values; those of tetrahedra are followed by those behind the boundary triangles.
    template <class T>
    void add_values(const PartValues& values, const std::vector<T>& numbers) {
        const std::int64_t width = values.components;
        const bool of_points = values.of == PartValues::Of::points;
        require_sizes(std::ssize(numbers) == width * (of_points ? points_ : tet_count_));
        const auto of_facet = [&numbers, &part = part_, width](std::int64_t i) {
            const std::int32_t t = part.tet_at_facet[i / width];
            return t < 0 ? std::numeric_limits<T>::quiet_NaN() : numbers[width * t + i % width];
        };
        const std::int64_t behind = of_points ? 0 : width * facet_count_;
        grid_.add(VtuArray<CheckedFile>::of<T>(of_points ? "PointData" : "CellData", values.name, width,
                                               of_points ? points_ : grid_.cells,
                                               [&numbers, of_facet, behind](CheckedFile& file) {
                                                   file.write(numbers.data(), numbers.size() * sizeof(T));
                                                   write_computed<T>(file, behind, of_facet);
                                               }));
    }

    static inline const std::vector<Tetrahedron> no_tets;
    static inline const EdgeNodes no_edge_nodes;

    const Part& part_;
    const std::vector<Tetrahedron>& tets_;
    const EdgeNodes& edge_nodes_;
    bool is_quadratic_;
    std::int64_t vertices_ = 0, points_ = 0, tet_count_ = 0, facet_count_ = 0;
    Grid grid_;
};

FileHash write_grid_file(const std::string& path, const Grid& grid) {
    Hasher hasher;
    CheckedFile file(path, "wb");
    file.hash_into(hasher);
    grid.write(file);
    file.close();
    return hasher.digest();
}

constexpr const char* nowhere = "/dev/null";

}  // namespace

VtuLayout layout_for(const MeshOutline& outline, CellFieldSet fields) {
    std::int64_t largest = std::max(std::ssize(outline.patch_names), std::ssize(outline.region_names));
    for (const PartExtent& part : outline.parts) largest = std::max<std::int64_t>(largest, part.id.value());
    const auto fits = [&](std::int64_t limit) { return outline.is_whole && largest <= limit; };
    const int tag_bytes = fits(std::numeric_limits<std::int8_t>::max())    ? 1
                          : fits(std::numeric_limits<std::int16_t>::max()) ? 2
                                                                           : 4;
    return {fields, tag_bytes, !outline.region_names.empty()};
}

FileHash write_part(const std::string& path, const Part& part, const VtuLayout& layout,
                    std::span<const PartValues> values) {
    return write_grid_file(path, GridMaker(part, true).part_grid(layout, values));
}

FileHash hash_of_part(const Part& part, const VtuLayout& layout) { return write_part(nowhere, part, layout); }

FileHash write_part_surface(const std::string& path, const Part& part) {
    return write_grid_file(path, GridMaker(part, false).surface_grid());
}

FileHash hash_of_part_surface(const Part& part) { return write_part_surface(nowhere, part); }

std::string pvtu_text(const std::vector<std::string>& pieces, const VtuLayout& layout,
                      std::span<const PartValues> values) {
    // Only the names and types of the arrays are asked for, so that they are those of the pieces.
    const Part no_part;
    std::vector<PartValues> no_values(values.begin(), values.end());
    for (PartValues& of_part : no_values) std::visit([](auto& numbers) { numbers.clear(); }, of_part.numbers);
    return pvtu_text(GridMaker(no_part, true).part_grid(layout, no_values).heads(), pieces);
}

void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const VtuLayout& layout,
                std::span<const PartValues> values) {
    write_text_file(path, pvtu_text(pieces, layout, values));
}

VtuLayout layout_of(const VtuHeader& header) {
    VtuLayout layout{{}, 4, header.find("Region") != nullptr};
    for (std::size_t field = 0; field < cell_fields.size(); ++field)
        layout.fields[field] = header.find(cell_fields[field].array) != nullptr;
    if (const VtuHeader::Array* tag = header.find("Part"))
        layout.tag_bytes = tag->type == vtk_type<std::int8_t> ? 1 : tag->type == vtk_type<std::int16_t> ? 2 : 4;
    return layout;
}

}  // namespace kerf
