// Measures of quality of cells in part files.
#pragma once

#include <array>
#include <bitset>
#include <functional>
#include <span>
#include <string_view>

#include "files/part/part.h"
#include "fill/mesh/quality.h"

namespace kerf {

/// A quality that cells of part files may have.
struct CellField {
    const char* name;   ///< word for --fields
    const char* array;  ///< name of the array in the file
    double TetQuality::*measure;
};
inline constexpr std::array<CellField, 5> cell_fields = {
    {{"min-dihedral", "MinDihedralAngle", &TetQuality::min_dihedral_deg},
     {"max-dihedral", "MaxDihedralAngle", &TetQuality::max_dihedral_deg},
     {"radius-edge", "RadiusEdgeRatio", &TetQuality::radius_edge},
     {"aspect", "AspectRatio", &TetQuality::aspect},
     {"shape", "Shape", &TetQuality::shape}}};
/// A set of them, a bit for each place in cell_fields.
using CellFieldSet = std::bitset<cell_fields.size()>;
/// The set with the smallest dihedral angle alone.
inline constexpr CellFieldSet default_cell_fields = 1;

/// Parses names with commas between, `all` or `none`; an empty text is default_cell_fields. Throws Error(usage).
CellFieldSet parse_cell_fields(std::string_view list);

/// Calls take(column, first cell, values), some cells at a time, with a column for each of the fields. The cells are
/// the tetrahedra, then the boundary triangles, which have the quality of the tetrahedron behind them, NaN if there is
/// none.
void for_all_cell_fields(
    const Part& part, CellFieldSet fields,
    const std::function<void(std::size_t column, std::int64_t first, std::span<const float> values)>& take);

}  // namespace kerf
