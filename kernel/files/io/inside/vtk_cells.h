// The cells of VTK's grids and surfaces, in whatever kind of file they are, on their way to a SoupBuilder.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

class SoupBuilder;

namespace vtu {

/// Throws the Error(input) of a file; `what` is a sentence and what to do.
[[noreturn]] void fail(const std::string& path, const std::string& what);

/// Names of arrays that tell the region of a cell: Kerf's, then those that meshio makes of other formats. The first
/// counts that all pieces have.
inline constexpr std::array<const char*, 4> region_arrays = {"Region", "gmsh:physical", "medit:ref", "attribute"};
/// Names of arrays that tell the regions on the two sides of a triangle, -1: outside.
inline constexpr const char *front_array = "front", *back_array = "back";
/// Names of arrays that tell the part behind a triangle and the patch that it lies on, -1: none.
inline constexpr const char *neighbour_array = "Neighbour", *patch_array = "Patch";
/// Names of the arrays of field data with the names of regions and of patches, and the numbers that have these names.
inline constexpr std::array<const char*, 4> name_arrays = {"RegionNames", "RegionNumbers", "PatchNames",
                                                           "PatchNumbers"};

/// Returns the name that an array of cells has above; empty for arrays that are not read. "front" and "back" may be
/// written in any case. `is_integer`: its numbers are whole.
std::string cell_array_of(std::string_view name, bool is_integer);

/// Cells of one piece. Of the last five, which have a number for each cell, those are empty that the file lacks.
struct Cells {
    std::vector<std::int64_t> corners, ends, types;
    std::vector<std::int64_t> neighbours, patches, regions, front, back;
};

using Names = std::map<std::int64_t, std::string>;

/// Returns names, each ended by a zero byte in `bytes`: of these numbers, or of those from 0 if there are none.
Names names_of(std::span<const std::int64_t> bytes, std::span<const std::int64_t> numbers);

/// Gives a builder the pieces of a file. Polygons become fans, strips triangles. Errors name the cell.
class CellTaker {
 public:
    CellTaker(const std::string& path, Names patch_names, SoupBuilder& builder)
        : path_(path), patch_names_(std::move(patch_names)), builder_(builder) {}

    /// Adds the points, three coordinates each, and the cells over them. Throws Error(input).
    void add(std::span<const double> coordinates, const Cells& cells);
    /// Gives the builder the names of regions, of tetrahedra or, if all pieces have them, of the sides of triangles.
    void finish(const Names& region_names, bool has_regions, bool has_sides);

 private:
    void check_ends(const Cells& cells) const;
    bool add_cell(const Cells& cells, std::size_t cell, std::vector<std::int64_t>& corners);
    void add_triangles(std::int64_t type, const std::vector<std::int64_t>& corners, std::size_t cell);
    void set_patch(const Cells& cells, std::size_t cell);
    void set_sides(const Names& region_names);
    [[noreturn]] void fail_cell(std::size_t cell, const std::string& what) const;

    const std::string& path_;
    Names patch_names_;
    SoupBuilder& builder_;
    std::vector<std::array<std::int64_t, 2>> sides_;  // of facets, by the numbers of the file
};

}  // namespace vtu

}  // namespace kerf
