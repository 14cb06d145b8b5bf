// What still keeps a surface from being meshed, and facets without which it is gone.
#pragma once

#include <vector>

#include "surface/soup.h"

namespace kerf {

struct RemainingDefect {
    std::vector<std::int32_t> facets;  ///< of the soup, at least one
    Vec3 where = Vec3::Zero();
};

/// The defects that diagnose() calls errors and that facets have: open loops of at most `most_edges` edges, edges and
/// vertices that are not manifold, facets that cross or have no area. Cost as diagnose().
std::vector<RemainingDefect> find_remaining_defects(const Soup& soup, double most_edges);

}  // namespace kerf
