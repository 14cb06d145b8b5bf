// Facets that are too sharp for good cells.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/complex/complex.h"

namespace kerf {

/// Whether `count` of `facets` is more than one in a thousand: cells beside bad facets are no better than these, and at
/// that share about one cell in a hundred is beside one.
constexpr bool spoil_cells(std::int64_t count, std::int64_t facets) { return 1000 * count > facets; }

struct Slivers {
    std::int64_t count = 0;  ///< facets with an angle below 10 degrees
    std::int64_t facets = 0;

    double share() const { return facets > 0 ? static_cast<double>(count) / facets : 0; }
    bool spoil_cells() const { return kerf::spoil_cells(count, facets); }
};
/// Counts the slivers of facets.
Slivers find_slivers(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);
/// Counts the slivers of all facets of a complex, without a copy of them.
Slivers find_slivers(const Complex& complex);

/// Returns which facets may stay where slivers are remeshed (#F): those further than two rings of facets from any
/// sliver. Empty where that is less than half of them. O(#F).
std::vector<char> facets_away_from_slivers(const SurfaceArrays& surface);

/// Returns a sentence on the effect of slivers on cells, and one that `remedy`, a command or an option, cures that,
/// unless it is empty. Returns nothing if they spoil no cells.
std::string sliver_note(const Slivers& slivers, const std::string& remedy);

}  // namespace kerf
