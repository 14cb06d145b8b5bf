// The patches of a surface, summarised for somebody who has to name them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The size, place and direction of a patch, of a surface as it was read, or of the boundary of a mesh.
struct PatchSummary {
    std::string name;
    std::string face = {};  ///< surface of a CAD model of which the patch is a face, as "cylinder r = 2"; empty: none
    std::int64_t triangles = 0;
    double area = 0;
    Vec3 centroid = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  ///< mean normal, weighted by area: shorter than 1 where the patch is curved, 0 where
                                 ///< it is closed

    /// Adds a triangle, with its corners counter-clockwise seen from outside; `centroid` and `normal` are sums weighted
    /// by area until finish().
    void add(const Vec3& a, const Vec3& b, const Vec3& c);
    void finish();
};

/// Returns all patches in the order of their numbers. O(#F).
std::vector<PatchSummary> summarize_patches(const Soup& soup);

/// Returns a table with a line for each patch; the name is last. A patch without triangles is said to lie inside.
std::string to_text(const std::vector<PatchSummary>& patches);

/// Returns how formats spell patches that they cannot call by their names, as in "solid 1/face 1: solid_1_face_1 in
/// openfoam": a line for each patch, but one for all that only get _ in the place of other characters. Empty if all
/// formats use the names.
std::string spellings_text(const std::vector<std::string>& patch_names);

}  // namespace kerf
