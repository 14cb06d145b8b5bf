// Facets that are too sharp for good cells.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/complex.h"

namespace kerf {

/// Whether so many of the facets are more than one in a thousand: the cells there are no better than it, and a cell of
/// a hundred or so is there.
constexpr bool spoil_cells(std::int64_t count, std::int64_t facets) { return 1000 * count > facets; }

struct Slivers {
    std::int64_t count = 0;  ///< facets with an angle below 10 degrees
    std::int64_t facets = 0;

    double share() const { return facets > 0 ? static_cast<double>(count) / static_cast<double>(facets) : 0; }
    bool spoil_cells() const { return kerf::spoil_cells(count, facets); }
};
Slivers find_slivers(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);
/// Those of all facets, without a copy of them.
Slivers find_slivers(const Complex& complex);

/// Which facets may stay where slivers are remeshed: those further than two rings of facets from any. Empty where that
/// is less than half of them. O(#F).
std::vector<char> facets_away_from_slivers(const SurfaceArrays& surface);

/// A sentence on what they do to the cells, and one that `remedy`, a command or an option, cures that, unless it is
/// empty. Returns nothing if they spoil nothing.
std::string sliver_note(const Slivers& slivers, const std::string& remedy);

}  // namespace kerf
