// Numbers by which VTK tells cells apart.
#pragma once

#include <cstdint>

namespace kerf {

inline constexpr std::uint8_t vtk_vertex = 1, vtk_poly_line = 4, vtk_triangle = 5, vtk_tetra = 10;

}  // namespace kerf
