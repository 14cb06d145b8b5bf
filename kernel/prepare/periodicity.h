// Surfaces of volume elements that repeat: what lies on one side lies on the opposite one, too, moved along an axis.
// Whose solver joins both sides needs them to stay so.
#pragma once

#include <optional>
#include <vector>

#include "surface/surface.h"

namespace kerf {

struct Periodicity {
    Vec3 period = Vec3::Zero();   ///< along x, y and z; positive
    std::vector<char> is_paired;  ///< #F; the facet with each corner moved by one period is a facet, too
    bool is_kept = false;         ///< whether these facets stay as they are in a run

    std::int64_t paired_facets() const;
};

/// The period along each axis is the largest shift, beyond half of the surface's extent, at which half as many vertices
/// have a partner as at any; the sides need not be flat. Returns nothing unless there are partners along all three
/// axes, for a fiftieth of the vertices and ten at least: the two ends of an extruded part match as well, and are
/// nobody's volume element. Places are the same within 1e-6 of the diagonal. O(#V log #V + #F log #F).
std::optional<Periodicity> find_periodicity(const SurfaceArrays& surface);

}  // namespace kerf
