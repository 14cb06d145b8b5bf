// Numbers by which VTK tells cells apart.
#pragma once

#include <cstdint>

namespace kerf {

inline constexpr std::uint8_t vtk_vertex = 1, vtk_poly_line = 4, vtk_triangle = 5, vtk_tetra = 10;
/// With a node on each edge, behind the corners.
inline constexpr std::uint8_t vtk_quadratic_triangle = 22, vtk_quadratic_tetra = 24;

/// Whether cells of this type have nodes between their corners.
constexpr bool has_higher_order(std::int64_t vtk_type) {
    return (vtk_type >= 21 && vtk_type <= 37) || (vtk_type >= 60 && vtk_type <= 81);
}

}  // namespace kerf
