// A surface that can be meshed around one that cannot.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/user_number.h"
#include "surface/soup.h"

namespace kerf {

struct WrapOptions {
    static constexpr double usual_gap_share = 0.02, usual_offset_share = 0.125;

    Length gap;     ///< openings narrower than this are closed; 0: usual_gap_share of the diagonal, or what gives some
                    ///< 100,000 facets if that is more
    Length offset;  ///< sheets become walls of up to twice this thickness; 0: usual_offset_share of the gap
};

/// What a wrap is, and how far from what it was put around.
struct WrapReport {
    double gap = 0, offset = 0;      ///< that were used, units of the surface
    std::int64_t facets_before = 0;  ///< of the surface
    std::int64_t left_out = 0;       ///< of these, because they have no area or no finite coordinates
    std::int64_t seen = 0;           ///< of these, that nothing of the surface covers on at least one of their sides
    std::int64_t facets = 0;         ///< of the wrap
    double distance_to_input = 0;    ///< nothing of the wrap is further from the surface; proven
    double distance_from_input = 0;  ///< nothing of the facets seen is further from the wrap; proven
};

/// Puts a closed, manifold surface without intersections around any facets, its normals out of it, and that in their
/// place: alpha_wrap() by balls of half of the gap, drawn back to the facets (pulled_back()), so that edges and corners
/// return. Each facet has the patch of that of the surface which is nearest. What the facets bound (Soup::sides),
/// seeds, the model's edges and the numbers of the file are gone.
///
/// Openings narrower than the gap are closed, and so are grooves: what lies inside is lost. Through wider ones the
/// inside is reached: walls become thin shells there. Vertex numbers must be in range. `poll` is called every few
/// milliseconds, and ends the work by what it throws. Throws Error(usage) for lengths out of range, Error(input) for no
/// facets. Deterministic. Some 3000 facets of the result a second; memory some 1 kB for each facet of input and result.
WrapReport wrap(Soup& soup, const WrapOptions& options, const std::function<void()>& poll = {});

/// The lengths that are used on a surface; all else is 0. Throws Error(usage), naming the option, for lengths out of
/// range, and for a gap so small that there would be millions of facets. O(#F).
WrapReport wrap_lengths(const Soup& soup, const WrapOptions& options);

/// What the distance of a wrap from its surface will hardly exceed, before it is made: half of the gap where openings
/// are closed, and the offset. Throws as wrap_lengths(). O(#F).
double estimated_wrap_distance(const Soup& soup, const WrapOptions& options = {});

/// "gap 0.2, offset 0.02: from 12,000 facets ...", for people.
std::string to_text(const WrapReport& report);

}  // namespace kerf
