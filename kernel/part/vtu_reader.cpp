// The header names each array and its place, where the array's size comes first. Every array is checked against both
// and against the numbers of cells and vertices. The cells are T tetrahedra, then F triangles.
#include "part/vtu_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <span>
#include <string_view>

#include "io/checked_file.h"
#include "io/file_bytes.h"
#include "io/vtk_cell_types.h"
#include "part/vtu_writer.h"

namespace kerf {

namespace {

constexpr std::string_view closing_tag = "</VTKFile>\n";

class PartBytes {
 public:
    explicit PartBytes(const std::string& path)
        : path_(path),
          bytes_(read_file(path)),
          header_(parse_vtu_header(std::string_view(bytes_).substr(0, vtu_header_limit), path)) {
        if (!bytes_.ends_with(closing_tag)) fail("it does not end with the closing tag");
    }

    const VtuHeader& header() const { return header_; }
    [[noreturn]] void fail(const std::string& what) const { fail_damaged_vtu(path_, what); }

    std::string_view raw(const char* name) const {
        const VtuHeader::Array* array = header_.find(name);
        if (!array) fail(fmt::format("it has no array {}", name));
        const std::size_t position = std::min(bytes_.size(), static_cast<std::size_t>(array->position));
        const std::string_view rest = std::string_view(bytes_).substr(position);
        std::uint64_t size = 0;
        if (rest.size() < sizeof size) fail(fmt::format("it ends before the array {}", name));
        std::memcpy(&size, rest.data(), sizeof size);
        if (size > rest.size() - sizeof size) fail(fmt::format("it ends within the array {}", name));
        return rest.substr(sizeof size, size);
    }

    template <class T>
    std::vector<T> values(const char* name, std::int64_t count) const {
        const std::string_view data = raw(name);
        if (data.size() % sizeof(T) || data.size() / sizeof(T) != static_cast<std::size_t>(count))
            fail(fmt::format("its array {} has {} bytes, which are not {} values", name, data.size(), count));
        std::vector<T> result(data.size() / sizeof(T));
        if (!data.empty()) std::memcpy(static_cast<void*>(result.data()), data.data(), data.size());
        return result;
    }

 private:
    const std::string& path_;
    std::string bytes_;
    VtuHeader header_;
};

std::int64_t count_tets(const PartBytes& file) {
    const auto types = file.values<std::uint8_t>("types", file.header().cell_count);
    const auto is = [](std::uint8_t type) { return [type](std::uint8_t other) { return other == type; }; };
    const auto first_facet = std::find_if_not(types.begin(), types.end(), is(vtk_tetra));
    if (!std::all_of(first_facet, types.end(), is(vtk_triangle)))
        file.fail("its cells are not tetrahedra and then triangles");
    return first_facet - types.begin();
}

void check_offsets(const PartBytes& file, std::int64_t tet_count) {
    const auto offsets = file.values<std::int64_t>("offsets", file.header().cell_count);
    std::int64_t end = 0;
    for (std::int64_t cell = 0; cell < file.header().cell_count; ++cell) {
        end += cell < tet_count ? 4 : 3;
        if (offsets[cell] != end)
            file.fail(fmt::format("the offset of cell {} is {}, not {}", cell, offsets[cell], end));
    }
}

// Takes cells from the front of the corners; every corner must be one of the first `vertex_count` vertices.
template <class Cell>
std::vector<Cell> take_cells(const PartBytes& file, std::span<const std::int32_t>& corners, std::int64_t count,
                             std::int64_t vertex_count) {
    std::vector<Cell> cells(count);
    for (Cell& cell : cells) {
        std::copy_n(corners.begin(), cell.size(), cell.begin());
        corners = corners.subspan(cell.size());
        for (const std::int32_t v : cell)
            if (v < 0 || v >= vertex_count) file.fail(fmt::format("a cell names vertex {} of {}", v, vertex_count));
    }
    return cells;
}

// The values of the facets in an array over all cells; every tetrahedron must have `of_tets`.
std::vector<std::int32_t> facet_values(const PartBytes& file, const char* name, std::int64_t tet_count,
                                       std::int32_t of_tets) {
    auto values = file.values<std::int32_t>(name, file.header().cell_count);
    const auto first_facet = values.begin() + tet_count;
    if (std::count(values.begin(), first_facet, of_tets) != tet_count)
        file.fail(fmt::format("a tetrahedron has a value of {} other than {}", name, of_tets));
    values.erase(values.begin(), first_facet);
    return values;
}

std::int32_t common_part(const PartBytes& file) {
    const auto parts = file.values<std::int32_t>("Part", file.header().cell_count);
    if (parts.empty()) file.fail("it has no cells");
    if (std::count(parts.begin(), parts.end(), parts.front()) != file.header().cell_count)
        file.fail("its cells belong to several parts");
    return parts.front();
}

std::vector<std::string> read_names(const PartBytes& file) {
    std::vector<std::string> names;
    std::string_view rest = file.raw("PatchNames");
    while (!rest.empty()) {
        const std::size_t end = rest.find('\0');
        if (end == rest.npos) file.fail("the last of its PatchNames is not complete");
        names.emplace_back(rest.substr(0, end));
        rest.remove_prefix(end + 1);
    }
    return names;
}

}  // namespace

Part read_part(const std::string& path) {
    const PartBytes file(path);
    const VtuHeader& header = file.header();
    const std::int64_t tet_count = count_tets(file), facet_count = header.cell_count - tet_count;
    check_offsets(file, tet_count);

    Part part;
    part.mesh.vertices = file.values<Vec3>("Points", header.point_count);
    part.mesh.boundary_vertex_count = static_cast<std::int32_t>(header.boundary_vertex_count);
    const auto connectivity = file.values<std::int32_t>("connectivity", 4 * tet_count + 3 * facet_count);
    std::span<const std::int32_t> corners = connectivity;
    part.mesh.tets = take_cells<Tetrahedron>(file, corners, tet_count, header.point_count);
    part.facets = take_cells<Triangle>(file, corners, facet_count, header.boundary_vertex_count);
    part.id = common_part(file);
    part.patch = facet_values(file, "Patch", tet_count, -1);
    part.facet = facet_values(file, "Facet", tet_count, -1);
    part.neighbour = facet_values(file, "Neighbour", tet_count, -1);
    part.global_id = file.values<std::int64_t>("GlobalVertexId", header.point_count);
    part.patch_names = read_names(file);
    return part;
}

bool is_complete_part_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string end(closing_tag.size(), '\0');
    file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    return file.read(end.data(), static_cast<std::streamsize>(end.size())) && end == closing_tag;
}

PartCellCounts read_cell_counts(const std::string& path) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const VtuHeader::Array* corners = header.find("connectivity");
    const std::int64_t tets = corners ? corners->tuples - 3 * header.cell_count : -1;
    if (tets < 0 || tets > header.cell_count) fail_damaged_vtu(path, "its cells are not tetrahedra and then triangles");
    return {tets, header.cell_count - tets};
}

std::vector<float> read_cell_values(const std::string& path, const std::string& name, std::int64_t first,
                                    std::int64_t count) {
    CheckedFile file(path, "rb");
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const VtuHeader::Array* array = header.find(name);
    if (!array || array->type != "Float32" || array->components != 1 || array->tuples != header.cell_count)
        fail_damaged_vtu(path, fmt::format("it has no array {} with a number for every cell", name));
    if (first < 0 || count < 0 || first > header.cell_count - count)
        fail_damaged_vtu(path, fmt::format("it has {} cells, and not those from {} to {}", header.cell_count, first,
                                           first + count - 1));
    std::vector<float> values(static_cast<std::size_t>(count));
    constexpr std::int64_t item_size = sizeof(float), size_of_array = sizeof(std::uint64_t);
    file.seek(array->position + size_of_array + first * item_size);
    const std::string bytes = file.read(values.size() * sizeof(float));
    if (bytes.size() != values.size() * sizeof(float))
        fail_damaged_vtu(path, fmt::format("it ends within the array {}", name));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

}  // namespace kerf
