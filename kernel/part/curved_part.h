// The cells of a part with curved edges, made valid.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/curved_tet.h"
#include "mesh/edge_table.h"
#include "part/part.h"

namespace kerf {

/// The places of the nodes of a cell of order 2.
TetNodes places_of_nodes(const Part& part, std::int64_t tet);

/// An edge of a part whose node is not in its middle.
struct CurvedEdge {
    std::int32_t edge;  ///< of the table
    Vec3 node;
};

struct CurvedPart {
    std::vector<CurvedEdge> curved;          ///< ascending; with those inside whose nodes were moved
    std::vector<std::int32_t> straightened;  ///< of the edges that were to be curved, ascending
    std::int64_t moved = 0;                  ///< edges inside whose nodes were moved
    std::int64_t cells = 0;                  ///< that have a curved edge
    double worst_scaled_jacobian = 1;        ///< of them (mesh/curved_tet.h)
    double volume_gain = 0;                  ///< of the part
};

/// The scaled Jacobian below which a cell is as good as invalid: the next rounding could make it so.
inline constexpr double least_scaled_jacobian = 0.01;

/// Puts nodes on `wanted` edges (ascending), each on the boundary of the mesh, and proves every cell valid that has
/// one, with least_scaled_jacobian and more. Where one is not, nodes of edges inside are moved first, to where the
/// least coefficient of the Jacobian determinants around them is largest; then one edge after the other of such a cell
/// gets its node in its middle again. `inside`: of each edge, whether it is none of the boundary. The cells must be
/// positively oriented. Deterministic: a function of the arguments. O(#T), and some milliseconds for each cell that is
/// not valid.
CurvedPart curve_part(const TetMesh& mesh, const EdgeTable& edges, const std::vector<char>& inside,
                      const std::vector<CurvedEdge>& wanted);

}  // namespace kerf
