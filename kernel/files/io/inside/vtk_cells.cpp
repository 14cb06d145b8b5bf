// Triangles, polygons and strips become facets, tetrahedra cells; quadratic ones are cut down to their corners, which
// come first. Regions come from an array of the cells, for tetrahedra, or from arrays of triangles with the regions on
// their sides. Numbers of regions are those of the file until all cells are read, and are made consecutive in their
// order then.
#include "files/io/inside/vtk_cells.h"

#include <algorithm>
#include <numeric>

#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/region_facets.h"
#include "files/io/soup_builder.h"
#include "files/io/vtk_cell_types.h"

namespace kerf::vtu {

namespace {

bool is_surface_cell(std::int64_t type) {
    return type == vtk_triangle || type == vtk_triangle_strip || type == vtk_polygon || type == vtk_quad;
}

// Cuts the nodes of a quadratic cell down to its corners, and returns the type of first order.
std::int64_t take_corners(std::int64_t type, std::vector<std::int64_t>& nodes, SoupBuilder& builder) {
    const std::size_t corners = type == vtk_quadratic_triangle ? 3 : type == vtk_quadratic_tetra ? 4 : 0;
    if (corners == 0 || nodes.size() != (corners == 3 ? 6U : 10U)) return type;
    nodes.resize(corners);
    builder.count_cell_by_corners();
    return corners == 3 ? vtk_triangle : vtk_tetra;
}

std::string region_name(const Names& names, std::int64_t number) {
    const auto found = names.find(number);
    return found != names.end() && !found->second.empty() ? found->second : "region_" + std::to_string(number);
}

}  // namespace

void fail(const std::string& path, const std::string& what) { throw Error(ErrorCode::input, path + ": " + what); }

std::string cell_array_of(std::string_view name, bool is_integer) {
    if (name == neighbour_array) return neighbour_array;
    if (!is_integer) return {};
    if (name == patch_array) return patch_array;
    if (std::find(region_arrays.begin(), region_arrays.end(), name) != region_arrays.end()) return std::string(name);
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
    return lower == front_array || lower == back_array ? lower : std::string();
}

Names names_of(std::span<const std::int64_t> bytes, std::span<const std::int64_t> numbers) {
    std::vector<std::string> names;
    std::string name;
    for (const std::int64_t byte : bytes) {
        if (byte != 0) {
            name += static_cast<char>(byte);
            continue;
        }
        names.push_back(std::move(name));
        name.clear();
    }
    if (!name.empty()) names.push_back(std::move(name));
    Names of_numbers;
    const std::size_t count = numbers.empty() ? names.size() : std::min(names.size(), numbers.size());
    for (std::size_t i = 0; i < count; ++i)
        of_numbers[numbers.empty() ? static_cast<std::int64_t>(i) : numbers[i]] = std::move(names[i]);
    return of_numbers;
}

void CellTaker::add(std::span<const double> coordinates, const Cells& cells) {
    check_ends(cells);
    const std::int64_t first_vertex = builder_.vertex_count();
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
        builder_.add_vertex({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
    std::vector<std::int64_t> corners;
    std::int64_t begin = 0, ignored = 0;
    for (std::size_t cell = 0; cell < cells.types.size(); ++cell) {
        corners.clear();
        for (; begin < cells.ends[cell]; ++begin)  // a negative corner stays one
            corners.push_back(cells.corners[begin] < 0 ? -1 : cells.corners[begin] + first_vertex);
        ignored += !add_cell(cells, cell, corners);
    }
    builder_.note_ignored(ignored, "cell that is no tetrahedron or triangle",
                          "cells that are no tetrahedra or triangles");
}

void CellTaker::check_ends(const Cells& cells) const {
    std::int64_t begin = 0;
    for (const std::int64_t end : cells.ends) {
        if (end < begin || end > std::ssize(cells.corners))
            fail(path_, "the offsets of its cells do not rise. Save it again.");
        begin = end;
    }
}

// Adds a tetrahedron or a cell of a surface; returns false for other cells.
bool CellTaker::add_cell(const Cells& cells, std::size_t cell, std::vector<std::int64_t>& corners) {
    const std::int64_t type = take_corners(cells.types[cell], corners, builder_);
    if (has_higher_order(type))
        fail_cell(cell, "it is of VTK's type " + std::to_string(type) +
                            ", which has nodes between its corners. Save the mesh with cells of first order.");
    builder_.count_other_cells(is_other_volume(type));
    const bool is_surface = is_surface_cell(type);
    if (type != vtk_tetra && !is_surface) return false;
    const std::size_t wanted = type == vtk_tetra || type == vtk_quad ? 4 : type == vtk_triangle ? 3 : corners.size();
    if (corners.size() != wanted)
        fail_cell(cell, "it has " + std::to_string(corners.size()) + " corners. Save the mesh again.");
    if (!is_surface) {
        const std::int32_t volume = cells.regions.empty() ? 0 : builder_.tets().volume({0, cells.regions[cell]});
        builder_.tets().add(
            corners, [&](const std::string& what) { fail_cell(cell, what); }, volume);
        return true;
    }
    set_patch(cells, cell);
    add_triangles(type, corners, cell);
    if (!cells.front.empty()) sides_.resize(builder_.soup().facets.size(), {cells.front[cell], cells.back[cell]});
    return true;
}

void CellTaker::add_triangles(std::int64_t type, const std::vector<std::int64_t>& corners, std::size_t cell) {
    const auto fail_here = [&](const std::string& what) { fail_cell(cell, what); };
    if (type != vtk_triangle_strip) return builder_.add_polygon(corners, fail_here);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::size_t odd = i % 2;  // every other triangle of a strip is turned round
        builder_.add_polygon(std::array{corners[i - 2 + odd], corners[i - 1 - odd], corners[i]}, fail_here);
    }
}

void CellTaker::set_patch(const Cells& cells, std::size_t cell) {
    if (!cells.neighbours.empty() && cells.neighbours[cell] >= 0) return builder_.set_patch(interface_patch);
    if (cells.patches.empty() || cells.patches[cell] < 0) return builder_.set_unnamed_patch();
    const auto name = patch_names_.find(cells.patches[cell]);
    builder_.set_patch(name != patch_names_.end() && !name->second.empty()
                           ? name->second
                           : "patch_" + std::to_string(cells.patches[cell]));
}

void CellTaker::finish(const Names& region_names, bool has_regions, bool has_sides) {
    if (!builder_.wants_tets() && !sides_.empty() && has_sides) set_sides(region_names);
    if (has_regions)
        builder_.tets().name_volumes([&](const VolumeKey& key) { return region_name(region_names, key.second); });
}

// Regions of the numbers that occur, in their order.
void CellTaker::set_sides(const Names& region_names) {
    std::map<VolumeKey, std::int32_t> regions;
    for (const auto& pair : sides_)
        for (const std::int64_t number : pair)
            if (number >= 0) regions.try_emplace({0, number}, 0);
    std::int32_t count = 0;
    for (auto& [key, place] : regions) place = count++;
    const VolumeRegions found =
        regions_of(regions, [&](const VolumeKey& key) { return region_name(region_names, key.second); });
    const auto region = [&](std::int64_t number) {
        return number < 0 ? RegionIndex::none() : found.region_of_volume[regions.at({0, number})];
    };
    std::vector<FacetSides> sides;
    for (const auto& [front, back] : sides_) sides.push_back({region(front), region(back)});
    builder_.set_sides(std::move(sides), found.names);
}

void CellTaker::fail_cell(std::size_t cell, const std::string& what) const {
    fail(path_, "cell " + std::to_string(cell) + ": " + what);
}

}  // namespace kerf::vtu
