// Measures of a repaired surface, and its distance from the one before.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "surface/soup/soup.h"

namespace kerf {

/// Measures of a soup with or without defects.
struct SoupMeasures {
    std::int64_t facets = 0;
    double area = 0;               ///< area of all facets with finite coordinates, each once
    std::optional<double> volume;  ///< enclosed; of regions their sum. None: an edge is open, or not finite
};

/// Measures of a repair. A facet counts as one of the input, turned or not, if it has the same three places as corners.
struct RepairMeasures {
    SoupMeasures before, after;
    std::int64_t changed_facets = 0;  ///< facets of the result: pieces of facets of the file, or with moved corners
    std::int64_t added_facets = 0;    ///< facets of the result: fillings, caps and walls, behind those of the file
    std::int64_t lost_facets = 0;     ///< facets of the input that the result does not have as they were
    /// Proven bounds, units of the surface: no point of a changed, or of an added, facet is farther from the input;
    /// infinite where that could not be proven. Within a fourth of the least bound that there is.
    double distance_of_changed = 0, distance_of_added = 0;
};

SoupMeasures measure_soup(const Soup& soup);

/// Measures a repair. `before`: welded exactly; its facets without finite coordinates do not count. `after`: facets
/// numbered as repair() does. `check_cancelled`: called again and again, ends the work by throwing. O(#F log #F).
RepairMeasures measure_repair(const Soup& before, const Soup& after, const std::function<void()>& check_cancelled = {});

}  // namespace kerf
