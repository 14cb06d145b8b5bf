// What the patches of a surface are, for who has to name them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"
#include "surface/soup.h"

namespace kerf {

/// What a patch is, of a surface as it was read, or of the boundary of a mesh.
struct PatchSummary {
    std::string name;
    std::int64_t triangles = 0;
    double area = 0;
    Vec3 centroid = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  ///< mean, weighted by area: shorter than 1 where the patch is curved, 0 where closed

    /// Adds a triangle, with its corners counter-clockwise seen from outside; `centroid` and `normal` are sums weighted
    /// by area until finish().
    void add(const Vec3& a, const Vec3& b, const Vec3& c);
    void finish();
};

/// All patches in the order of their numbers. O(#F).
std::vector<PatchSummary> summarize_patches(const Soup& soup);

/// A table with a line for each patch; the name is last.
std::string to_text(const std::vector<PatchSummary>& patches);

/// A line for each patch that a format does not call by its name, with what it is called there, as in "openfoam
/// face_1"; formats that agree stand together. Empty if all of them use the names.
std::string spellings_text(const std::vector<std::string>& patch_names);

}  // namespace kerf
