// The triangles of the user's surface that a case speaks of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/patch_summary.h"
#include "solve/elastic_case.h"
#include "solve/fe_space.h"

namespace kerf {

/// A boundary triangle of this rank.
struct SurfaceFacet {
    std::size_t part = 0;   ///< of this rank's
    std::size_t facet = 0;  ///< of the part
    double area = 0;
    Vec3 normal = Vec3::Zero();  ///< unit vector, outwards; of a curved one that of its corners
};

/// Finds what selections name. All functions are collective, and throw alike on all ranks.
class SurfaceSelector {
 public:
    /// `names`: of the patches of the mesh. O(F).
    SurfaceSelector(const FeSpace& space, std::vector<std::string> names);

    /// Triangles that are selected, on this rank. `who` begins the message of Error(usage) that is thrown for a patch
    /// that the mesh does not have, or if nothing is selected on any rank. O(F).
    std::vector<SurfaceFacet> facets(const SurfaceSelection& where, const std::string& who) const;
    /// Row of the vertex of the surface next to the point; of several the one with the smallest row. Collective. Throws
    /// Error(usage), with `who` asks, for a point outside of the box around the body.
    std::int64_t nearest_vertex(const Vec3& point, const std::string& who) const;
    /// All that the mesh has, in the order of their numbers.
    std::vector<PatchSummary> summaries() const;
    /// Which patches the names stand for. Throws Error(usage) naming those that there are.
    std::vector<char> match(const std::vector<std::string>& patterns, const std::string& who) const;
    double diagonal() const { return diagonal_; }  ///< of the box around the mesh

 private:
    bool selects(const SurfaceSelection& where, const std::vector<char>& patches, const SurfaceFacet& facet) const;

    const FeSpace& space_;
    std::vector<std::string> names_;
    std::vector<SurfaceFacet> surface_;  // all on this rank
    double diagonal_ = 0;
    Vec3 low_, high_;  // of the box around the mesh
};

/// Whether the pattern, in which '*' stands for any characters, is all of the text. O(n m).
bool matches_pattern(const std::string& pattern, const std::string& text);

}  // namespace kerf
