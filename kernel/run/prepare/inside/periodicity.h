// Surfaces of volume elements that repeat: each side has its like on the opposite side, moved along an axis. Solvers
// that join both sides need them to stay so.
#pragma once

#include <optional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The period of a surface, and the facets that match across it.
struct Periodicity {
    Vec3 period = Vec3::Zero();  ///< along x, y and z; positive
    /// #F; whether a facet has a partner: one that has its corners moved by one period, and looks the other way, so
    /// that both ends of a hole, or two holes that are alike, are no pair.
    std::vector<char> is_paired;
    bool is_kept = false;  ///< whether these facets stay as they are in a run

    std::int64_t paired_facets() const;
};

/// Finds the period of a surface. Along each axis it is the largest shift, beyond half of the surface's extent, at
/// which half as many vertices have a partner as at any; the sides need not be flat. Returns nothing unless along all
/// three axes a fiftieth of the vertices have partners, ten at least, and ten facets: the two ends of an extruded part
/// match as well, but such a part is no volume element. Places are the same within 1e-6 of the diagonal. O(#V log #V +
/// #F log #F).
std::optional<Periodicity> find_periodicity(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
