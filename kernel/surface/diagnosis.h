// Everything that keeps a triangle soup from being the boundary of a body, or that will give bad cells.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "surface/defect.h"
#include "surface/orientation.h"

namespace kerf {

/// A shell inside another one that is turned like it may be a second body or a void: refused, or taken as a void.
enum class Voids { as_given, parity };

struct DiagnosisOptions {
    Voids voids = Voids::as_given;
    double needle_angle_deg = 1;  ///< facets with a smaller angle are needles
};

/// Defects ordered by kind, then by first facet.
struct Diagnosis {
    std::vector<Defect> defects;
    std::array<std::int64_t, defect_kind_count> counts = {};  ///< found of each kind; more than listed of some
    std::vector<char> dropped;                                ///< #F; facets that repairs leave out. Empty: none
    /// What turns the soup, where it is known: of a surface of one body that is clean, and as it is.
    std::optional<Orientation> orientation = {};

    /// The surface can be meshed, after repairs.
    bool clean() const;
    std::int64_t count(DefectKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    /// One sentence: the most fundamental error, how many, the first with numbers and coordinates, and what to do.
    std::string summary(const Soup& soup) const;
    /// The elements of all errors of that kind, in their order.
    std::vector<ErrorElements> elements(const Soup& soup) const;
};

/// Finds all defects in one pass, each check on what it can work with: edges on facets without repeated vertices,
/// intersections on those with an area. Shells are located only where the surface is otherwise a closed manifold. All
/// decisions about topology and intersections are exact. Where the soup says what lies on the sides of its facets, a
/// Complex tells whether its regions close. `soup`: its numbers in range; welded, without unused vertices;
/// Soup::polygon ascending. At most 10,000
/// self-intersections, and the 1000 worst needles and shortest edges, are listed. O(#F log #F), on threads, with the
/// same result for any number of them. Beside the soup some 20 B a facet at the end, and 40 B on the way there, without
/// what find_self_intersections() needs.
Diagnosis diagnose(const Soup& soup, const DiagnosisOptions& options = {});

}  // namespace kerf
