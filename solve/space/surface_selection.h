// The triangles of the user's surface that a case selects.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/report/patch_summary.h"
#include "solve/case/elastic_case.h"
#include "solve/space/fe_space.h"

namespace kerf {

/// A boundary triangle of this rank.
struct SurfaceFacet {
    std::size_t part = 0;   ///< index among the parts of this rank
    std::size_t facet = 0;  ///< index among the facets of the part
    double area = 0;
    Vec3 normal = Vec3::Zero();  ///< unit vector, outwards; that of the corners where it is curved
};

/// Finds the triangles and vertices of selections. All functions are collective, and throw alike on all ranks.
class SurfaceSelector {
 public:
    /// `names`: those of the patches of the mesh. O(F).
    SurfaceSelector(const FeSpace& space, std::vector<std::string> names);

    /// Returns the selected triangles of this rank. `who` begins the message of Error(usage) that is thrown for a patch
    /// that the mesh does not have, or if nothing is selected on any rank. O(F).
    std::vector<SurfaceFacet> facets(const SurfaceSelection& where, const std::string& who) const;
    /// Returns the row of the vertex of the surface nearest to the point; of several the smallest row. Collective.
    /// Throws Error(usage), beginning with `who`, for a point away from the box around the body by more than 1 percent
    /// of its diagonal.
    std::int64_t nearest_vertex(const Vec3& point, const std::string& who) const;
    /// Returns all patches of the mesh, in the order of their numbers.
    std::vector<PatchSummary> summaries() const;
    /// Returns a flag for each patch: whether one of the patterns stands for it. Throws Error(usage), with a list of
    /// the patches, for a pattern that stands for none.
    std::vector<char> match(const std::vector<std::string>& patterns, const std::string& who) const;
    double diagonal() const { return diagonal_; }  ///< of the box around the mesh

 private:
    bool selects(const SurfaceSelection& where, const std::vector<char>& patches, const SurfaceFacet& facet) const;

    const FeSpace& space_;
    std::vector<std::string> names_;
    std::vector<SurfaceFacet> surface_;  // all triangles on this rank
    double diagonal_ = 0;
    Vec3 low_, high_;  // of the box around the mesh
};

}  // namespace kerf
