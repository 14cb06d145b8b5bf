// The header names each array and its place, where the array's size comes first. Every array is checked against both
// and against the numbers of cells and vertices, before its values are used as indices. The cells are T tetrahedra,
// then F triangles, and so are all arrays over cells. Arrays are read in the order that the content asks for, with a
// jump to each, so that a surface costs no memory for tetrahedra. An array that older versions do not write is optional
// here.
#include "files/part/vtu_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "base/core/elements.h"
#include "files/io/checked_file.h"
#include "files/io/vtk_cell_types.h"
#include "files/part/inside/edge_node_reader.h"
#include "files/part/inside/part_arrays_file.h"
#include "files/part/vtu_writer.h"

namespace kerf {

namespace {

constexpr std::string_view closing_tag = "</VTKFile>\n";

std::int64_t count_tets(PartArraysFile& file) {
    std::int64_t tets = 0, facets = 0;
    const bool is_quadratic = file.header().order == 2;
    const std::uint8_t of_tet = is_quadratic ? vtk_quadratic_tetra : vtk_tetra;
    const std::uint8_t of_facet = is_quadratic ? vtk_quadratic_triangle : vtk_triangle;
    file.open<std::uint8_t>("types", file.header().cell_count);
    file.visit<std::uint8_t>(file.header().cell_count, [&](std::uint8_t type) {
        if (type != of_facet && (type != of_tet || facets > 0))
            file.fail("its cells are not tetrahedra and then triangles");
        ++(type == of_tet ? tets : facets);
    });
    return tets;
}

void check_offsets(PartArraysFile& file, std::int64_t tet_count) {
    std::int64_t cell = 0, end = 0;
    file.visit_integers<std::int32_t, std::int64_t>("offsets", file.header().cell_count, [&](std::int64_t offset) {
        end += cell < tet_count ? file.nodes_of_tet() : file.nodes_of_facet();
        if (offset != end) file.fail(fmt::format("the offset of cell {} is {}, not {}", cell, offset, end));
        ++cell;
    });
}

// Takes the corners of the next cells of the open array, which have so many `nodes`; every corner must be one of the
// first `vertex_count` vertices.
template <class Cells, std::size_t nodes>
Cells take_corners(PartArraysFile& file, std::int64_t count, std::int64_t vertex_count) {
    Cells cells;
    cells.reserve(count);
    file.visit<std::array<std::int32_t, nodes>>(count, [&](const std::array<std::int32_t, nodes>& cell) {
        auto& corners = cells.emplace_back();
        std::copy_n(cell.begin(), corners.size(), corners.begin());
        for (const std::int32_t v : corners)
            if (v < 0 || v >= vertex_count) file.fail(fmt::format("a cell names vertex {} of {}", v, vertex_count));
    });
    return cells;
}

// Calls visit(value) with the values of an array over all cells.
template <class Visit>
void visit_tags(PartArraysFile& file, const char* name, Visit visit) {
    file.visit_integers<std::int8_t, std::int16_t, std::int32_t>(name, file.header().cell_count, visit);
}

// Returns the values of the facets in an array over all cells; every tetrahedron must have -1.
std::vector<std::int32_t> facet_values(PartArraysFile& file, const char* name, std::int64_t tet_count) {
    std::vector<std::int32_t> values;
    std::int64_t cell = 0;
    visit_tags(file, name, [&](std::int32_t value) {
        if (cell++ >= tet_count) return values.push_back(value);
        if (value != -1) file.fail(fmt::format("a tetrahedron has a value of {} other than -1", name));
    });
    return values;
}

// Reads the facets of the input, which have an array of their own unless the file is a surface or of an older version.
std::vector<std::int32_t> read_input_facets(PartArraysFile& file, std::int64_t tet_count) {
    const VtuHeader::Array* array = file.header().find("Facet");
    if (array && array->tuples == file.header().cell_count) return facet_values(file, "Facet", tet_count);
    const std::int64_t facet_count = file.header().cell_count - tet_count;
    file.open<std::int32_t>("Facet", facet_count);
    return file.take<std::int32_t>(facet_count);
}

NodeId common_part(PartArraysFile& file) {
    if (file.header().cell_count == 0) file.fail("it has no cells");
    std::int32_t part = -1;
    visit_tags(file, "Part", [&](std::int32_t value) {
        if (part >= 0 && value != part) file.fail("its cells belong to several parts");
        part = value;
    });
    return NodeId(part);
}

std::vector<std::string> read_names(PartArraysFile& file, const char* array) {
    const auto bytes = file.take<char>(file.open(array));
    std::vector<std::string> names;
    std::string_view rest(bytes.data(), bytes.size());
    while (!rest.empty()) {
        const std::size_t end = rest.find('\0');
        if (end == rest.npos) file.fail(fmt::format("the last of its {} is not complete", array));
        names.emplace_back(rest.substr(0, end));
        rest.remove_prefix(end + 1);
    }
    return names;
}

// Reads a table of names; files with all names have no numbers of these.
NameTable read_name_table(PartArraysFile& file, const char* array, const char* numbers_array) {
    std::vector<std::string> names = read_names(file, array);
    if (!file.header().find(numbers_array)) return names;
    file.open<std::int32_t>(numbers_array, std::ssize(names));
    const auto numbers = file.take<std::int32_t>(std::ssize(names));
    if (!NameTable::can_be(numbers)) file.fail(fmt::format("its {} do not rise from 0", numbers_array));
    return {numbers, std::move(names)};
}

// Reads the names of regions, and the runs of cells in them; a surface is one run. There are none for one region.
void read_regions(PartArraysFile& file, std::int64_t tet_count, Part& part) {
    if (!file.header().find("Region")) return;
    part.region_names = read_name_table(file, "RegionNames", "RegionNumbers");
    std::int32_t cell = 0, last = -1;
    visit_tags(file, "Region", [&](std::int32_t region) {
        if (region != std::exchange(last, region) && !part.region_names.has(region))
            file.fail("a cell lies in a region without a name");
        const bool is_counted = cell < tet_count || part.regions.empty();
        if (is_counted && (part.regions.empty() || part.regions.back().region != RegionIndex(region)))
            part.regions.push_back({cell, RegionIndex(region)});
        ++cell;
    });
}

// Reads the vertices and edges at which other parts may touch this one without a triangle in common.
void read_contacts(PartArraysFile& file, Part& part) {
    if (!file.header().find("ContactVertices")) return;
    const std::uint64_t vertices = file.open("ContactVertices");
    part.contact_vertices = file.take<std::int32_t>(vertices / sizeof(std::int32_t));
    const std::uint64_t edges = file.open("ContactEdges");
    part.contact_edges = file.take<UndirectedEdge>(edges / sizeof(UndirectedEdge));
    const std::size_t boundary = file.header().boundary_vertex_count;
    const auto is_boundary = [&](std::int32_t v) { return v >= 0 && std::cmp_less(v, boundary); };
    if (!std::all_of(part.contact_vertices.begin(), part.contact_vertices.end(), is_boundary) ||
        !are_in_range(part.contact_edges, boundary))
        file.fail("a contact names no vertex of the boundary");
}

// Reads the points of the vertices, then those of nodes on edges.
void read_points(PartArraysFile& file, Part& part) {
    const auto& [points, vertices] = std::pair(file.header().point_count, file.header().vertex_count);
    file.open<Vec3>("Points", points);
    part.mesh.vertices = file.take<Vec3>(vertices);
    part.edge_nodes.points = file.take<Vec3>(points - vertices);
}

void read_global_ids(PartArraysFile& file, Part& part) {
    const auto& [points, vertices] = std::pair(file.header().point_count, file.header().vertex_count);
    part.mesh.boundary_vertex_count = file.header().boundary_vertex_count;
    file.open<std::int64_t>("GlobalVertexId", points);
    part.global_id = file.take<std::int64_t>(vertices);
    part.edge_nodes.global_id = file.take<std::int64_t>(points - vertices);
}

// Reads the corners of tetrahedra and triangles.
void read_connectivity(PartArraysFile& file, std::int64_t tets, Part& part) {
    const VtuHeader& header = file.header();
    const std::int64_t facets = header.cell_count - tets;
    file.open<std::int32_t>("connectivity", file.nodes_of_tet() * tets + file.nodes_of_facet() * facets);
    if (header.order == 1) {
        part.mesh.tets = take_corners<Array<CellId, Tetrahedron>, 4>(file, tets, header.vertex_count);
        part.facets = take_corners<std::vector<Triangle>, 3>(file, facets, header.boundary_vertex_count);
        return;
    }
    part.mesh.tets = take_corners<Array<CellId, Tetrahedron>, 10>(file, tets, header.vertex_count);
    part.facets = take_corners<std::vector<Triangle>, 6>(file, facets, header.boundary_vertex_count);
    find_edges(file, part);
}

void read_cells(PartArraysFile& file, Part& part) {
    const std::int64_t tet_count = count_tets(file);
    check_offsets(file, tet_count);
    read_connectivity(file, tet_count, part);
    part.id = common_part(file);
    part.patch = facet_values(file, "Patch", tet_count);
    part.facet = read_input_facets(file, tet_count);
    for (const std::int32_t neighbour : facet_values(file, "Neighbour", tet_count))
        part.neighbour.emplace_back(neighbour);
    part.patch_names = read_name_table(file, "PatchNames", "PatchNumbers");
    read_regions(file, tet_count, part);
    read_contacts(file, part);
}

}  // namespace

Part read_part(const std::string& path, PartContent content) {
    PartArraysFile file(path);
    Part part;
    if (content != PartContent::cells) read_points(file, part);
    read_global_ids(file, part);
    if (content != PartContent::vertices) read_cells(file, part);
    return part;
}

bool is_complete_part_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string end(closing_tag.size(), '\0');
    file.seekg(-std::ssize(end), std::ios::end);
    return file.read(end.data(), end.size()) && end == closing_tag;
}

bool has_cell_values(const std::string& path, const std::string& array) {
    CheckedFile file(path, "rb");
    return parse_vtu_header(file.read(vtu_header_limit), path).find_of_cells(array) != nullptr;
}

VtuLayout read_layout(const std::string& path) {
    CheckedFile file(path, "rb");
    return layout_of(parse_vtu_header(file.read(vtu_header_limit), path));
}

PartPointCounts read_point_counts(const std::string& path) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    return {header.order, header.vertex_count, header.point_count - header.vertex_count};
}

PartCellCounts read_cell_counts(const std::string& path) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const VtuHeader::Array* nodes = header.find("connectivity");
    const std::int64_t of_facet = 3 * header.order, more_of_tet = header.order == 1 ? 1 : 4;
    const std::int64_t more = nodes ? nodes->tuples - of_facet * header.cell_count : -1, tets = more / more_of_tet;
    if (more < 0 || more % more_of_tet != 0 || tets > header.cell_count)
        fail_damaged_vtu(path, "its cells are not tetrahedra and then triangles");
    return {tets, header.cell_count - tets};
}

namespace {

// Reads bytes of the values of an array.
std::string read_bytes(CheckedFile& file, const VtuHeader::Array& array, std::int64_t first, std::size_t count,
                       const std::string& path) {
    constexpr std::int64_t size_of_array = sizeof(std::uint64_t);
    file.seek(array.position + size_of_array + first);
    std::string bytes = file.read(count);
    if (bytes.size() != count) fail_damaged_vtu(path, fmt::format("it ends within the array {}", array.name));
    return bytes;
}

}  // namespace

std::vector<float> read_cell_values(const std::string& path, const std::string& name, std::int64_t first,
                                    std::int64_t count) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const VtuHeader::Array* array = header.find_of_cells(name);
    if (!array || array->type != "Float32" || array->components != 1)
        fail_damaged_vtu(path, fmt::format("it has no array {} with a number for every cell", name));
    if (first < 0 || count < 0 || first > header.cell_count - count)
        fail_damaged_vtu(path, fmt::format("it has {} cells, and not those from {} to {}", header.cell_count, first,
                                           first + count - 1));
    std::vector<float> values(count);
    const std::string bytes =
        read_bytes(file, *array, first * std::int64_t{sizeof(float)}, values.size() * sizeof(float), path);
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

namespace {

// Finds the arrays of values: all of floating point that are no qualities of cells, those of points, then those of
// cells.
struct ValueArrays {
    std::vector<const VtuHeader::Array*> of_points, of_cells;
};
ValueArrays value_arrays(const VtuHeader& header) {
    ValueArrays found;
    std::vector<const VtuHeader::Array*>* section = nullptr;
    for (const VtuHeader::Array& array : header.arrays) {
        const auto is_quality = [&](const CellField& field) { return array.name == field.array; };
        if (array.name == "Points") break;
        if (array.name == "GlobalVertexId")
            section = &found.of_points;
        else if (array.name == "Part")
            section = &found.of_cells;
        else if (section && array.type.starts_with("Float") &&
                 std::none_of(cell_fields.begin(), cell_fields.end(), is_quality))
            section->push_back(&array);
    }
    return found;
}

PartValues nameless_numbers(const VtuHeader::Array& array, PartValues::Of of) {
    PartValues values;
    values.name = array.name;
    values.of = of;
    values.components = array.components;
    if (array.type == "Float64") values.numbers = std::vector<double>();
    return values;
}

}  // namespace

std::vector<PartValues> read_value_names(const std::string& path) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const ValueArrays arrays = value_arrays(header);
    std::vector<PartValues> names;
    for (const VtuHeader::Array* array : arrays.of_points)
        names.push_back(nameless_numbers(*array, PartValues::Of::points));
    for (const VtuHeader::Array* array : arrays.of_cells)
        names.push_back(nameless_numbers(*array, PartValues::Of::tets));
    return names;
}

std::vector<PartValues> read_values(const std::string& path) {
    const std::int64_t tets = read_cell_counts(path).tets;
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const ValueArrays arrays = value_arrays(header);
    std::vector<PartValues> all;
    const auto read = [&](const VtuHeader::Array& array, PartValues::Of of, std::int64_t tuples) {
        if (array.tuples < tuples) fail_damaged_vtu(path, fmt::format("its array {} is too short", array.name));
        PartValues values = nameless_numbers(array, of);
        std::visit(
            [&](auto& numbers) {
                using Number = typename std::decay_t<decltype(numbers)>::value_type;
                numbers.resize(tuples * array.components);
                const std::string bytes = read_bytes(file, array, 0, numbers.size() * sizeof(Number), path);
                if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
            },
            values.numbers);
        all.push_back(std::move(values));
    };
    for (const VtuHeader::Array* array : arrays.of_points) read(*array, PartValues::Of::points, header.point_count);
    for (const VtuHeader::Array* array : arrays.of_cells) read(*array, PartValues::Of::tets, tets);
    return all;
}

}  // namespace kerf
