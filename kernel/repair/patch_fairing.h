// A patch in a hole that goes on as the surface around it does.
#pragma once

#include <array>
#include <vector>

#include "repair/patch_mesh.h"

namespace kerf {

/// What is around a patch.
struct PatchSurroundings {
    std::vector<std::array<std::int32_t, 3>> facets;  ///< at the rims; numbers of rim points, then of `points`
    std::vector<Vec3> points;                         ///< counted on from the points of the rims
    std::vector<char> is_whole;                       ///< of each rim point: these and the patch are all around it
};

/// Moves the points within the rims to where the mean curvature changes least: the sum of the squares of the discrete
/// Laplacian at all points of the patch, its rims among them, by cotangents (botsch2004), has its minimum there. A
/// plane goes on as a plane, a sphere nearly as a sphere. Three rounds, with flips. False where that moves a point by
/// more than the rims are wide, or to nowhere: then the patch is not to be used. O(n^1.5).
bool fair_patch(PatchMesh& patch, const PatchSurroundings& around);

}  // namespace kerf
