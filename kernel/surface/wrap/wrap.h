// A surface that can be meshed, put around one that cannot.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/core/user_number.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The lengths of a wrap, as users give them.
struct WrapOptions {
    static constexpr double usual_gap_share = 0.02, usual_offset_share = 0.125;

    Length gap;     ///< openings narrower than this are closed; 0: usual_gap_share of the diagonal, or the gap for some
                    ///< 100,000 facets if that is more
    Length offset;  ///< sheets become walls of up to twice this thickness; 0: usual_offset_share of the gap
};

/// The measures of a wrap, and its distances from the surface inside of it.
struct WrapReport {
    double gap = 0, offset = 0;      ///< the lengths that were used, units of the surface
    std::int64_t facets_before = 0;  ///< facets of the surface
    std::int64_t left_out = 0;       ///< facets of these without area or finite coordinates
    std::int64_t seen = 0;           ///< facets of these with a free view on one of their sides
    std::int64_t facets = 0;         ///< facets of the wrap
    double distance_to_input = 0;    ///< no point of the wrap is further from the surface; proven
    double distance_from_input = 0;  ///< no point of the facets seen is further from the wrap; proven
    double volume = 0;               ///< volume of the wrap
    /// Volume that the facets bound, where they are closed and turned alike, and about so where they nearly are.
    double volume_of_input = 0;
};

/// Replaces facets of any kind by a closed, manifold surface without intersections around them, its normals pointing
/// out. alpha_wrap() makes it by balls of half of the gap, and pulled_back() draws it back to the facets, so that edges
/// and corners return. Each facet has the patch of the nearest one of the surface. Sides (Soup::sides), seeds, the
/// model's edges and the numbers of the file are gone.
///
/// Openings narrower than the gap are closed, and so are grooves: details inside of them are lost. Through wider ones
/// the inside is reached: walls become thin shells there. Vertex numbers must be in range. `check_cancelled` is called
/// every few milliseconds, and ends the work by throwing. Throws Error(usage) for lengths out of range, Error(input) if
/// no facet has area. Deterministic. Some 3000 facets of the result a second; memory some 1 kB for each facet of input
/// and result.
WrapReport wrap(Soup& soup, const WrapOptions& options, const std::function<void()>& check_cancelled = {});

/// Returns the lengths that are used on a surface; all else is 0. Throws Error(usage), naming the option, for lengths
/// out of range, and for a gap so small that there would be millions of facets. O(#F).
WrapReport wrap_lengths(const Soup& soup, const WrapOptions& options);

/// Returns a distance from the surface that a wrap will hardly exceed, before it is made: half of the gap, by which
/// openings are closed, plus the offset. Throws as wrap_lengths(). O(#F).
double estimated_wrap_distance(const Soup& soup, const WrapOptions& options = {});

/// Returns a line for people: "12,000 facets around 4,000, gap 0.2, offset 0.02; ...".
std::string to_text(const WrapReport& report);

}  // namespace kerf
