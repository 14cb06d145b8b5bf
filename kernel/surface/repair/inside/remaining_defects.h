// Defects that still keep a surface from being meshed, and facets without which they are gone.
#pragma once

#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

struct RemainingDefect {
    std::vector<std::int32_t> facets;  ///< numbers in the soup, at least one
    Vec3 where = Vec3::Zero();
};

/// Returns the defects that diagnose() calls errors and that facets have: open loops of at most `most_edges` edges,
/// edges and vertices that are not manifold, and facets that cross, are copies or have no area. Cost as diagnose().
std::vector<RemainingDefect> find_remaining_defects(const Soup& soup, double most_edges);

}  // namespace kerf
