// VTU is XML around arrays: FieldData and Piece > Points, Cells, CellData > DataArray. First the structure of the whole
// file is read, with the place of each array in its bytes (files/io/inside/vtu_structure.h), then the values of the
// arrays that are needed, piece by piece (files/io/inside/vtu_arrays.h). Arrays of cells that are not read are passed
// over without decoding. Regions come from an array of the cells, for tetrahedra, or from the arrays
// "front" and "back" of triangles, which count only if all pieces have both. Numbers of regions are those of the file
// until all cells are read, and are made consecutive in their order then.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/region_facets.h"
#include "files/io/inside/vtu_arrays.h"
#include "files/io/inside/vtu_structure.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"
#include "files/io/vtk_cell_types.h"

namespace kerf {

namespace vtu {

namespace {

struct Cells {
    std::vector<std::int64_t> corners, ends, types, neighbours, regions, front, back;
};

// Regions on the sides of triangles, by the numbers of the file.
using FileSides = std::vector<std::array<std::int64_t, 2>>;

Cells read_cells(const Decoder& decoder, const Piece& piece, const std::string& region_array, const std::string& path) {
    Cells cells;
    cells.types = decoder.values<std::int64_t>(piece, "types", piece.cells);
    cells.ends = decoder.values<std::int64_t>(piece, "offsets", piece.cells);
    cells.corners = decoder.values<std::int64_t>(piece, "connectivity", piece.cells ? cells.ends.back() : 0);
    if (piece.arrays.contains("Neighbour"))
        cells.neighbours = decoder.values<std::int64_t>(piece, "Neighbour", piece.cells);
    if (!region_array.empty() && piece.cells > 0)
        cells.regions = decoder.values<std::int64_t>(piece, region_array, piece.cells);
    if (piece.cells > 0 && piece.arrays.contains(front_array) && piece.arrays.contains(back_array)) {
        cells.front = decoder.values<std::int64_t>(piece, front_array, piece.cells);
        cells.back = decoder.values<std::int64_t>(piece, back_array, piece.cells);
    }
    std::int64_t begin = 0;
    for (const std::int64_t end : cells.ends) {
        if (end < begin || end > std::ssize(cells.corners))
            fail(path, "the offsets of its cells do not rise. Save it again.");
        begin = end;
    }
    return cells;
}

// The array of cells that tells their regions; empty if there is none.
std::string region_array_of(const File& file) {
    for (const char* name : region_arrays) {
        const auto has_it = [&](const Piece& piece) { return piece.cells == 0 || piece.arrays.contains(name); };
        if (std::all_of(file.pieces.begin(), file.pieces.end(), has_it)) return name;
    }
    return {};
}

// Tells whether all pieces have the arrays of sides.
bool has_sides(const File& file) {
    return std::all_of(file.pieces.begin(), file.pieces.end(), [](const Piece& piece) {
        return piece.cells == 0 || (piece.arrays.contains(front_array) && piece.arrays.contains(back_array));
    });
}

using RegionNames = std::map<std::int64_t, std::string>;

// Returns the names of regions, each ended by a zero byte in the file: of the numbers from 0, unless an array says
// others.
RegionNames region_names_of(const File& file, const Decoder& decoder) {
    RegionNames of_numbers;
    if (!file.region_names) return of_numbers;
    std::vector<std::string> names;
    std::string name;
    for (const std::int64_t byte : decoder.values_of<std::int64_t>(*file.region_names)) {
        if (byte != 0) {
            name += static_cast<char>(byte);
            continue;
        }
        names.push_back(std::move(name));
        name.clear();
    }
    if (!name.empty()) names.push_back(std::move(name));
    std::vector<std::int64_t> numbers(names.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    if (file.region_numbers) numbers = decoder.values_of<std::int64_t>(*file.region_numbers);
    for (std::size_t i = 0; i < std::min(names.size(), numbers.size()); ++i)
        of_numbers[numbers[i]] = std::move(names[i]);
    return of_numbers;
}

bool is_triangle(std::int64_t type) { return type == vtk_triangle || type == vtk_quadratic_triangle; }

// Cuts the nodes of a quadratic cell down to its corners, which come first, and returns the type of first order.
std::int64_t take_corners(std::int64_t type, std::vector<std::int64_t>& nodes, SoupBuilder& builder) {
    const std::size_t corners = type == vtk_quadratic_triangle ? 3 : type == vtk_quadratic_tetra ? 4 : 0;
    if (corners == 0 || nodes.size() != (corners == 3 ? 6U : 10U)) return type;
    nodes.resize(corners);
    builder.count_cell_by_corners();
    return corners == 3 ? vtk_triangle : vtk_tetra;
}

// Adds a tetrahedron or a triangle; returns false for other cells.
template <class Fail>
bool add_cell(const Cells& cells, std::size_t cell, std::vector<std::int64_t>& corners, SoupBuilder& builder,
              const Fail& fail_cell) {
    const std::int64_t type = take_corners(cells.types[cell], corners, builder);
    if (has_higher_order(type))
        fail_cell("it is of VTK's type " + std::to_string(type) +
                  ", which has nodes between its corners. Save the mesh with cells of first order.");
    builder.count_other_cells(is_other_volume(type));
    if (type != vtk_tetra && type != vtk_triangle) return false;
    if (corners.size() != (type == vtk_tetra ? 4U : 3U))
        fail_cell("it has " + std::to_string(corners.size()) + " corners. Save the mesh again.");
    if (type == vtk_tetra) {
        const std::int32_t volume = cells.regions.empty() ? 0 : builder.tets().volume({0, cells.regions[cell]});
        builder.tets().add(corners, fail_cell, volume);
        return true;
    }
    if (!cells.neighbours.empty() && cells.neighbours[cell] >= 0)
        builder.set_patch(interface_patch);
    else
        builder.set_unnamed_patch();
    builder.add_polygon(corners, fail_cell);
    return true;
}

// Adds the cells of a piece, and the regions beside its triangles to `sides`.
void scan_piece(const Decoder& decoder, const Piece& piece, const std::string& region_array, const std::string& path,
                SoupBuilder& builder, FileSides& sides) {
    const std::int64_t first_vertex = builder.vertex_count();
    const std::vector<double> coordinates = decoder.values<double>(piece, "Points", 3 * piece.points);
    for (std::size_t i = 0; i < coordinates.size(); i += 3)
        builder.add_vertex({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
    for (const auto& [name, array] : piece.scalars) {
        if (!builder.wants_scalars()) break;
        const std::vector<double> values = decoder.values_of<double>(array);
        if (std::ssize(values) != piece.points)
            fail(path, "its array " + name + " has not one value for each point. Save or copy it again.");
        std::copy(values.begin(), values.end(), builder.tets().scalar(name).begin() + first_vertex);
    }
    const Cells cells = read_cells(decoder, piece, region_array, path);
    std::vector<std::int64_t> corners;
    std::int64_t begin = 0, ignored = 0;
    for (std::size_t cell = 0; cell < cells.types.size(); ++cell) {
        corners.clear();
        for (; begin < cells.ends[cell]; ++begin)  // a negative corner stays one
            corners.push_back(cells.corners[begin] < 0 ? -1 : cells.corners[begin] + first_vertex);
        ignored += !add_cell(cells, cell, corners, builder, [&](const std::string& what) {
            fail(path, "cell " + std::to_string(cell) + ": " + what);
        });
        if (!cells.front.empty() && is_triangle(cells.types[cell]))
            sides.push_back({cells.front[cell], cells.back[cell]});
    }
    builder.note_ignored(ignored, "cell that is no tetrahedron or triangle",
                         "cells that are no tetrahedra or triangles");
}

std::string region_name(const RegionNames& names, std::int64_t number) {
    const auto found = names.find(number);
    return found != names.end() && !found->second.empty() ? found->second : "region_" + std::to_string(number);
}

// Regions of the numbers that occur, in their order.
void set_sides(const FileSides& file_sides, const RegionNames& names, SoupBuilder& builder) {
    std::map<VolumeKey, std::int32_t> regions;
    for (const auto& pair : file_sides)
        for (const std::int64_t number : pair)
            if (number >= 0) regions.try_emplace({0, number}, 0);
    std::int32_t count = 0;
    for (auto& [key, place] : regions) place = count++;
    const VolumeRegions found =
        regions_of(regions, [&](const VolumeKey& key) { return region_name(names, key.second); });
    const auto region = [&](std::int64_t number) {
        return number < 0 ? RegionIndex::none() : found.region_of_volume[regions.at({0, number})];
    };
    std::vector<FacetSides> sides;
    for (const auto& [front, back] : file_sides) sides.push_back({region(front), region(back)});
    builder.set_sides(std::move(sides), found.names);
}

}  // namespace

}  // namespace vtu

void scan_vtu(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    const vtu::File file = vtu::read_structure(bytes, path);
    const vtu::Decoder decoder(file, path);
    const std::string region_array = builder.wants_scalars() ? std::string() : vtu::region_array_of(file);
    vtu::FileSides sides;
    for (const vtu::Piece& piece : file.pieces) vtu::scan_piece(decoder, piece, region_array, path, builder, sides);
    if (builder.wants_scalars()) return;
    const vtu::RegionNames names = vtu::region_names_of(file, decoder);
    if (!builder.wants_tets() && !sides.empty() && vtu::has_sides(file)) vtu::set_sides(sides, names, builder);
    if (!region_array.empty())
        builder.tets().name_volumes([&](const VolumeKey& key) { return vtu::region_name(names, key.second); });
}

Soup read_vtu(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    scan_vtu(bytes, path, builder);
    return builder.finish();
}

}  // namespace kerf
