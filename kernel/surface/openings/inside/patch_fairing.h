// A patch in a hole that goes on as the surface around it does.
#pragma once

#include <array>
#include <vector>

#include "surface/openings/inside/patch_mesh.h"

namespace kerf {

/// The surface around a patch.
struct PatchSurroundings {
    std::vector<std::array<std::int32_t, 3>> facets;  ///< facets at the rims; numbers of rim points, then of `points`
    std::vector<Vec3> points;                         ///< points beside the rims, numbered on from those of the rims
    std::vector<char> is_whole;                       ///< per rim point: only these facets and the patch are around it
};

/// Moves the points within the rims to where the mean curvature changes least: the sum of the squares of the discrete
/// Laplacian at all points of the patch, those of the rims included, by cotangents (Botsch and Kobbelt 2004,
/// botsch2004), has its minimum there. A plane goes on as a plane, a sphere nearly as a sphere. Three rounds, with
/// flips in between. Returns false where that would move a point by more than half of the diagonal of the box around
/// the rims, or to nowhere: then the patch is not to be used. O(n^1.5).
bool fair_patch(PatchMesh& patch, const PatchSurroundings& around);

}  // namespace kerf
