// Surfaces of volume elements that repeat: what lies on one side lies on the opposite one, too, moved along an axis.
// Whose solver joins both sides needs them to stay so.
#pragma once

#include <optional>
#include <vector>

#include "core/types.h"

namespace kerf {

struct Periodicity {
    Vec3 period = Vec3::Zero();  ///< along x, y and z; positive
    /// #F; the facet with each corner moved by one period is a facet that looks the other way: both ends of a hole, or
    /// two holes that are alike, are no pair.
    std::vector<char> is_paired;
    bool is_kept = false;  ///< whether these facets stay as they are in a run

    std::int64_t paired_facets() const;
};

/// The period along each axis is the largest shift, beyond half of the surface's extent, at which half as many vertices
/// have a partner as at any; the sides need not be flat. Returns nothing unless along all three axes a fiftieth of the
/// vertices have partners, ten at least, and ten facets: the two ends of an extruded part match as well, and are
/// nobody's volume element. Places are the same within 1e-6 of the diagonal. O(#V log #V + #F log #F).
std::optional<Periodicity> find_periodicity(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
