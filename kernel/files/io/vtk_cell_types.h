// The numbers by which VTK tells cells apart.
#pragma once

#include <cstdint>

namespace kerf {

inline constexpr std::uint8_t vtk_vertex = 1, vtk_poly_vertex = 2, vtk_poly_line = 4, vtk_triangle = 5,
                              vtk_triangle_strip = 6, vtk_polygon = 7, vtk_quad = 9, vtk_tetra = 10;
/// Cells with a node on each edge, behind the corners.
inline constexpr std::uint8_t vtk_quadratic_triangle = 22, vtk_quadratic_tetra = 24;

/// Tells whether cells of this type have nodes between their corners.
constexpr bool has_higher_order(std::int64_t vtk_type) {
    return (vtk_type >= 21 && vtk_type <= 37) || (vtk_type >= 60 && vtk_type <= 81);
}

/// Tells whether cells of this type are of first order, have a volume and are no tetrahedra.
constexpr bool is_other_volume(std::int64_t vtk_type) {
    constexpr std::int64_t vtk_voxel = 11, vtk_hexagonal_prism = 16, vtk_polyhedron = 42;
    return (vtk_type >= vtk_voxel && vtk_type <= vtk_hexagonal_prism) || vtk_type == vtk_polyhedron;
}

}  // namespace kerf
