// Facets that are too sharp for good cells.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/surface.h"

namespace kerf {

struct Slivers {
    std::int64_t count = 0;  ///< facets with an angle below 10 degrees
    std::int64_t facets = 0;

    double share() const { return facets > 0 ? static_cast<double>(count) / static_cast<double>(facets) : 0; }
    /// One facet in a thousand: the cells there are no better than it, and a cell of a hundred or so is there.
    bool spoil_cells() const { return 1000 * count > facets; }
};
Slivers find_slivers(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Which facets may stay where slivers are remeshed: those further than two rings of facets from any. Empty where that
/// is less than half of them. O(#F).
std::vector<char> facets_away_from_slivers(const SurfaceArrays& surface);

/// One sentence with the command that cures it, unless `path` is empty; empty if they spoil nothing.
std::string sliver_note(const Slivers& slivers, const std::string& path);

}  // namespace kerf
