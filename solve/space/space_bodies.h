// The connected pieces of a mesh, by the nodes of its elements.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/space/fe_space.h"

namespace kerf {

/// The bodies of all ranks, ascending by their smallest row.
struct SpaceBodies {
    std::int32_t count = 0;
    std::vector<std::int32_t> of_node;  ///< body of each local node, ghosts too
};

/// Finds the bodies: cells that share a vertex are of one body. Collective; O(n), times the number of ranks that one
/// body winds through.
SpaceBodies find_bodies(const FeSpace& space);

}  // namespace kerf
