// The regular tetrahedron: V = l^3 / (6 sqrt 2).
#pragma once

#include "base/core/cube_root.h"

namespace kerf {

inline constexpr double cubed_edge_of_unit_regular_tet = 8.485281374238570;  // 6 sqrt 2

inline double regular_tet_volume(double edge) { return edge * edge * edge / cubed_edge_of_unit_regular_tet; }
inline double regular_tet_edge(double volume) { return cube_root(cubed_edge_of_unit_regular_tet * volume); }

}  // namespace kerf
