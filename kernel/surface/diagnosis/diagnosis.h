// Everything that keeps a triangle soup from being the boundary of a body, or that will give bad cells.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "surface/diagnosis/inside/defect.h"
#include "surface/diagnosis/orientation.h"

namespace kerf {

/// Treatment of a shell inside another one that is turned like it, which may be a second body or a void: refused
/// (`as_given`), or taken as a void (`parity`).
enum class Voids { as_given, parity };

struct DiagnosisOptions {
    Voids voids = Voids::as_given;
    double needle_angle_deg = 1;  ///< facets with a smaller angle are needles
};

/// The defects of a soup, ordered by kind, then by first facet.
struct Diagnosis {
    std::vector<Defect> defects;
    std::array<std::int64_t, defect_kind_count> counts = {};  ///< defects found of each kind, of which not all need be
                                                              ///< listed
    std::vector<char> dropped;                                ///< #F; 1: a facet that repairs leave out. Empty: none
    /// The facets to be turned outwards. Known only for a single body that is clean with all its facets.
    std::optional<Orientation> orientation = {};

    /// Whether the surface can be meshed, after repairs.
    bool clean() const;
    std::int64_t count(DefectKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    /// Returns one sentence: the most fundamental error, how many there are of it, the first of them with numbers and
    /// coordinates, and the way to mend it.
    std::string summary(const Soup& soup) const;
    /// Returns the facets and vertices of all errors of the kind that summary() names, in their order.
    std::vector<ErrorElements> elements(const Soup& soup) const;
};

/// Finds all defects in one pass. Each check looks at the facets that it can work with: that of edges at facets without
/// repeated vertices, that of intersections at facets with an area. Shells are located only where the surface is
/// otherwise a closed manifold. All decisions about topology and intersections are exact. Where the soup has
/// Soup::sides, a Complex tells whether its regions close. `soup`: numbers in range; welded, without unused vertices;
/// Soup::polygon ascending. At most 10,000 self-intersections, and the 1000 worst needles and shortest edges, are
/// listed. O(#F log #F), on threads, with the same result for any number of them. Takes some 20 B a facet at the end
/// and 40 B before, beside the soup and the memory of find_self_intersections().
Diagnosis diagnose(const Soup& soup, const DiagnosisOptions& options = {});

}  // namespace kerf
