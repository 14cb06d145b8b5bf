// The nodes of second order: one on each edge of a part's tetrahedra.
#pragma once

#include <cstdint>
#include <vector>

#include "base/core/types.h"
#include "fill/mesh/edge_table.h"

namespace kerf {

/// Nodes on edges, in the order of the edges of the part, which is ascending by their ends. A straight edge has its
/// node at 0.5 * (a + b), to the last bit, in every part.
struct EdgeNodes {
    EdgeTable edges;
    std::vector<Vec3> points;             ///< #E
    std::vector<std::int64_t> global_id;  ///< #E; behind those of all vertices, the same in every part (EdgeNumbers)
};

/// The nodes of a whole mesh that lie elsewhere than in the middle of their edges.
struct CurvedNodes {
    std::vector<std::int64_t> ids;  ///< global numbers, ascending
    std::vector<Vec3> points;       ///< one for each

    template <class Archive>
    void archive(Archive& a) {
        a(ids, points);
    }
};

}  // namespace kerf
