// Pairs of rims between which a band is missing.
#pragma once

#include <functional>
#include <vector>

#include "surface/openings/inside/opening.h"

namespace kerf {

/// Joins openings of one rim each in pairs, where a band between the two is smaller than the areas that they enclose
/// together, and stands off the surface by hardly more (20 degrees) than the flatter one of their lids: the ring at the
/// end of a pipe with a wall, a piece of a pipe that is missing, an island in a hole; but not the two mouths of a short
/// pipe, nor two holes beside or above each other. The smallest band in relation to its lids comes first. Other
/// openings stay as they are, in their order. Of more than 2000 openings only the longest are considered. O(n^2) boxes,
/// and for those that are near enough a few distances. `check_cancelled`: called now and then.
std::vector<RimOpening> join_facing(const OpenRims& all, std::vector<RimOpening> openings,
                                    const std::function<void()>& check_cancelled);

}  // namespace kerf
