// The header names each array and its place, where the array's size comes first. Every array is checked against both
// and against the numbers of cells and vertices. The cells are T tetrahedra, then F triangles.
#include "part/vtu_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "core/elements.h"
#include "io/checked_file.h"
#include "io/vtk_cell_types.h"
#include "part/vtu_writer.h"

namespace kerf {

namespace {

constexpr std::string_view closing_tag = "</VTKFile>\n";

// The arrays of a part file, opened one at a time and taken from front to back, so that what nobody asks for costs no
// memory.
class PartArraysFile {
 public:
    explicit PartArraysFile(const std::string& path)
        : path_(path), file_(path, "rb"), header_(parse_vtu_header(file_.read(vtu_header_limit), path)) {
        if (!is_complete_part_file(path)) fail("it does not end with the closing tag");
        std::error_code ignored;
        size_ = std::filesystem::file_size(path, ignored);
    }

    const VtuHeader& header() const { return header_; }
    [[noreturn]] void fail(const std::string& what) const { fail_damaged_vtu(path_, what); }

    /// Stands before the first value of an array from now on. Returns its bytes.
    std::uint64_t open(const char* name) {
        const VtuHeader::Array* array = header_.find(name);
        if (!array) fail(fmt::format("it has no array {}", name));
        name_ = name;
        std::uint64_t size = 0;
        const std::uint64_t position = std::min(size_, static_cast<std::uint64_t>(array->position));
        if (size_ - position < sizeof size) fail(fmt::format("it ends before the array {}", name));
        file_.seek(position);
        read(&size, sizeof size);
        if (size > size_ - position - sizeof size) fail(fmt::format("it ends within the array {}", name));
        return size;
    }
    /// The same for an array that must have `count` values.
    template <class T>
    void open(const char* name, std::int64_t count) {
        const std::uint64_t size = open(name);
        if (size % sizeof(T) || size / sizeof(T) != static_cast<std::uint64_t>(count))
            fail(fmt::format("its array {} has {} bytes, which are not {} values", name, size, count));
    }

    template <class T>
    std::vector<T> take(std::int64_t count) {
        std::vector<T> values(count);
        read(static_cast<void*>(values.data()), values.size() * sizeof(T));
        return values;
    }
    /// Takes `count` values and calls visit(value) with each.
    template <class T, class Visit>
    void visit(std::int64_t count, Visit visit) {
        constexpr std::int64_t at_once = std::int64_t{1} << 16;
        for (; count > 0; count -= at_once)
            for (const T& value : take<T>(std::min(count, at_once))) visit(value);
    }
    /// Opens an array of `count` integers of any of these types and calls visit(value) with each.
    template <class... Types, class Visit>
    void visit_integers(const char* name, std::int64_t count, Visit visit) {
        const VtuHeader::Array* array = header_.find(name);
        const std::string type = array ? array->type : "";
        const auto visit_if = [&]<class T>(T) {
            if (type != name_of<T>) return false;
            open<T>(name, count);
            this->visit<T>(count, visit);
            return true;
        };
        if (!(visit_if(Types{}) || ...)) fail(fmt::format("it has no array {} of such integers", name));
    }

 private:
    template <class T>
    static constexpr const char* name_of = sizeof(T) == 1   ? "Int8"
                                           : sizeof(T) == 2 ? "Int16"
                                           : sizeof(T) == 4 ? "Int32"
                                                            : "Int64";
    void read(void* data, std::size_t size) {
        if (file_.read_into(data, size) != size) fail(fmt::format("it ends within the array {}", name_));
    }

    const std::string& path_;
    CheckedFile file_;
    VtuHeader header_;
    std::uint64_t size_ = 0;
    const char* name_ = "";
};

std::int64_t count_tets(PartArraysFile& file) {
    std::int64_t tets = 0, facets = 0;
    file.open<std::uint8_t>("types", file.header().cell_count);
    file.visit<std::uint8_t>(file.header().cell_count, [&](std::uint8_t type) {
        if (type != vtk_triangle && (type != vtk_tetra || facets > 0))
            file.fail("its cells are not tetrahedra and then triangles");
        ++(type == vtk_tetra ? tets : facets);
    });
    return tets;
}

void check_offsets(PartArraysFile& file, std::int64_t tet_count) {
    std::int64_t cell = 0, end = 0;
    file.visit_integers<std::int32_t, std::int64_t>("offsets", file.header().cell_count, [&](std::int64_t offset) {
        end += cell < tet_count ? 4 : 3;
        if (offset != end) file.fail(fmt::format("the offset of cell {} is {}, not {}", cell, offset, end));
        ++cell;
    });
}

// The next cells of the array that is open; every corner must be one of the first `vertex_count` vertices.
template <class Cell>
std::vector<Cell> take_cells(PartArraysFile& file, std::int64_t count, std::int64_t vertex_count) {
    std::vector<Cell> cells = file.take<Cell>(count);
    for (const Cell& cell : cells)
        for (const std::int32_t v : cell)
            if (v < 0 || v >= vertex_count) file.fail(fmt::format("a cell names vertex {} of {}", v, vertex_count));
    return cells;
}

// Calls visit(value) with those of an array over all cells.
template <class Visit>
void visit_tags(PartArraysFile& file, const char* name, Visit visit) {
    file.visit_integers<std::int8_t, std::int16_t, std::int32_t>(name, file.header().cell_count, visit);
}

// The values of the facets in an array over all cells; every tetrahedron must have -1.
std::vector<std::int32_t> facet_values(PartArraysFile& file, const char* name, std::int64_t tet_count) {
    std::vector<std::int32_t> values;
    std::int64_t cell = 0;
    visit_tags(file, name, [&](std::int32_t value) {
        if (cell++ >= tet_count) return values.push_back(value);
        if (value != -1) file.fail(fmt::format("a tetrahedron has a value of {} other than -1", name));
    });
    return values;
}

// Those of the input, which have an array of their own unless the file is a surface or of an older version.
std::vector<std::int32_t> read_input_facets(PartArraysFile& file, std::int64_t tet_count) {
    const VtuHeader::Array* array = file.header().find("Facet");
    if (array && array->tuples == file.header().cell_count) return facet_values(file, "Facet", tet_count);
    const std::int64_t facet_count = file.header().cell_count - tet_count;
    file.open<std::int32_t>("Facet", facet_count);
    return file.take<std::int32_t>(facet_count);
}

std::int32_t common_part(PartArraysFile& file) {
    if (file.header().cell_count == 0) file.fail("it has no cells");
    std::int32_t part = -1;
    visit_tags(file, "Part", [&](std::int32_t value) {
        if (part >= 0 && value != part) file.fail("its cells belong to several parts");
        part = value;
    });
    return part;
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

// The names of regions, and the runs of cells in them; a surface is one run. None where there is one region.
void read_regions(PartArraysFile& file, std::int64_t tet_count, Part& part) {
    if (!file.header().find("Region")) return;
    part.region_names = read_names(file, "RegionNames");
    std::int32_t cell = 0;
    visit_tags(file, "Region", [&](std::int32_t region) {
        if (region < 0 || region >= std::ssize(part.region_names)) file.fail("a cell lies in a region without a name");
        const bool is_counted = cell < tet_count || part.regions.empty();
        if (is_counted && (part.regions.empty() || part.regions.back().region != RegionIndex(region)))
            part.regions.push_back({cell, RegionIndex(region)});
        ++cell;
    });
}

// Where other parts may touch this one without a triangle in common.
void read_contacts(PartArraysFile& file, Part& part) {
    if (!file.header().find("ContactVertices")) return;
    const std::uint64_t vertices = file.open("ContactVertices");
    part.contact_vertices = file.take<std::int32_t>(static_cast<std::int64_t>(vertices / sizeof(std::int32_t)));
    const std::uint64_t edges = file.open("ContactEdges");
    part.contact_edges = file.take<UndirectedEdge>(static_cast<std::int64_t>(edges / sizeof(UndirectedEdge)));
    const auto boundary = static_cast<std::size_t>(file.header().boundary_vertex_count);
    const auto is_boundary = [&](std::int32_t v) { return v >= 0 && std::cmp_less(v, boundary); };
    if (!std::all_of(part.contact_vertices.begin(), part.contact_vertices.end(), is_boundary) ||
        !are_in_range(part.contact_edges, boundary))
        file.fail("a contact names no vertex of the boundary");
}

void read_vertices(PartArraysFile& file, Part& part) {
    file.open<Vec3>("Points", file.header().point_count);
    part.mesh.vertices = file.take<Vec3>(file.header().point_count);
}

void read_global_ids(PartArraysFile& file, Part& part) {
    part.mesh.boundary_vertex_count = file.header().boundary_vertex_count;
    file.open<std::int64_t>("GlobalVertexId", file.header().point_count);
    part.global_id = file.take<std::int64_t>(file.header().point_count);
}

void read_cells(PartArraysFile& file, Part& part) {
    const VtuHeader& header = file.header();
    const std::int64_t tet_count = count_tets(file), facet_count = header.cell_count - tet_count;
    check_offsets(file, tet_count);
    file.open<std::int32_t>("connectivity", 4 * tet_count + 3 * facet_count);
    part.mesh.tets = take_cells<Tetrahedron>(file, tet_count, header.point_count);
    part.facets = take_cells<Triangle>(file, facet_count, header.boundary_vertex_count);
    part.id = common_part(file);
    part.patch = facet_values(file, "Patch", tet_count);
    part.facet = read_input_facets(file, tet_count);
    part.neighbour = facet_values(file, "Neighbour", tet_count);
    part.patch_names = read_names(file, "PatchNames");
    read_regions(file, tet_count, part);
    read_contacts(file, part);
}

}  // namespace

Part read_part(const std::string& path, PartContent content) {
    PartArraysFile file(path);
    Part part;
    if (content != PartContent::cells) read_vertices(file, part);
    read_global_ids(file, part);
    if (content != PartContent::vertices) read_cells(file, part);
    return part;
}

bool is_complete_part_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string end(closing_tag.size(), '\0');
    file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    return file.read(end.data(), static_cast<std::streamsize>(end.size())) && end == closing_tag;
}

bool has_cell_values(const std::string& path, const std::string& array) {
    CheckedFile file(path, "rb");
    return parse_vtu_header(file.read(vtu_header_limit), path).find_of_cells(array) != nullptr;
}

VtuLayout read_layout(const std::string& path) {
    CheckedFile file(path, "rb");
    return layout_of(parse_vtu_header(file.read(vtu_header_limit), path));
}

PartCellCounts read_cell_counts(const std::string& path) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const VtuHeader::Array* corners = header.find("connectivity");
    const std::int64_t tets = corners ? corners->tuples - 3 * header.cell_count : -1;
    if (tets < 0 || tets > header.cell_count) fail_damaged_vtu(path, "its cells are not tetrahedra and then triangles");
    return {tets, header.cell_count - tets};
}

namespace {

// Of the values of an array.
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

// The arrays that are neither of every part file nor qualities of cells: those of points, then those of cells.
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
