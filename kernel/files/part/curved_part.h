// Makes the cells of a part with curved edges valid.
#pragma once

#include <cstdint>
#include <vector>

#include "files/part/part.h"
#include "fill/mesh/curved_tet.h"
#include "fill/mesh/edge_table.h"

namespace kerf {

/// Returns the places of the nodes of a cell of order 2.
TetNodes places_of_nodes(const Part& part, std::int64_t tet);

/// An edge of a part whose node is not in its middle.
struct CurvedEdge {
    std::int32_t edge;  ///< number in the table of edges
    Vec3 node;
};

struct CurvedPart {
    std::vector<CurvedEdge> curved;          ///< ascending; with edges inside whose nodes were moved
    std::vector<std::int32_t> straightened;  ///< those wanted edges that are straight again, ascending
    std::int64_t moved = 0;                  ///< edges inside whose nodes were moved
    std::int64_t cells = 0;                  ///< number of cells with a curved edge
    double worst_scaled_jacobian = 1;        ///< the worst of these cells (fill/mesh/curved_tet.h)
    double volume_gain = 0;                  ///< volume of these cells beyond that of the straight ones
};

/// The scaled Jacobian below which a cell is as good as invalid: the next rounding could make it so.
inline constexpr double least_scaled_jacobian = 0.01;

/// Puts nodes on `wanted` edges (ascending), each on the boundary of the mesh, and proves every cell with such an edge
/// valid, with a scaled Jacobian of least_scaled_jacobian and more. For a cell that is not, nodes of edges inside are
/// moved first, to where the least coefficient of the Jacobian determinants around them is largest; then one edge after
/// the other of the cell gets its node in its middle again. `inside`: for each edge, whether it is none of the
/// boundary. The cells must be positively oriented. Deterministic: a function of the arguments. O(#T), and some
/// milliseconds for each cell that is not valid.
CurvedPart curve_part(const TetMesh& mesh, const EdgeTable& edges, const std::vector<char>& inside,
                      const std::vector<CurvedEdge>& wanted);

}  // namespace kerf
