// How far a repaired surface is from the one that came.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "surface/soup.h"

namespace kerf {

/// What can be measured of a soup with and without defects.
struct SoupMeasures {
    std::int64_t facets = 0;
    double area = 0;               ///< of all facets with finite coordinates, each side of a wall once
    std::optional<double> volume;  ///< enclosed; of regions their sum. None: some edge is open, or not finite
};

/// A facet is that of the input, turned or not, if it has the same three places as corners.
struct RepairMeasures {
    SoupMeasures before, after;
    std::int64_t changed_facets = 0;  ///< of the result: pieces of facets of the file, or with moved corners
    std::int64_t added_facets = 0;    ///< of the result: fillings, caps and walls, behind the numbers of the file
    std::int64_t lost_facets = 0;     ///< of the input, that the result does not have as they were
    /// Proven bounds, units of the surface: no point of a changed, or of an added, facet is farther from the input;
    /// infinite where that could not be proven. Within a fourth of the least bound that there is.
    double distance_of_changed = 0, distance_of_added = 0;
};

SoupMeasures measure_soup(const Soup& soup);

/// `before`: welded exactly; its facets without finite coordinates do not count. `after`: facets numbered as repair()
/// does. `poll`: called again and again, ends the work by what it throws. O(#F log #F).
RepairMeasures measure_repair(const Soup& before, const Soup& after, const std::function<void()>& poll = {});

}  // namespace kerf
