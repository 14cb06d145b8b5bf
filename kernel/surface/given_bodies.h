// Closed bodies that are meshed together, while they are not known to be regions yet.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/diagnosis.h"

namespace kerf {

/// Who each facet of a soup belongs to.
struct GivenBodies {
    std::vector<std::int32_t> of_facet;  ///< #F; numbers of `names`
    std::vector<std::string> names;
};

/// The patches of a soup, if each of them that has facets is closed by itself: an even number of its facets is at every
/// edge. Else nothing, and where there is only one. O(#F log #F).
GivenBodies closed_patches(const Soup& soup);

/// Patches that have vertices in common are one body, called as the first of them. Of closed bodies that are apart
/// these are the bodies. O(#V + #F).
GivenBodies separate_patches(const Soup& soup);

/// Everything that is wrong with each body alone, as diagnose() finds it, Defect::bodies naming it; and, if these can
/// be meshed, where two of them overlap or have unlike facets in one place (surface/wall_mismatch.h). Requires what
/// diagnose() does.
Diagnosis diagnose_bodies(const Soup& soup, const GivenBodies& bodies, const DiagnosisOptions& options = {});

/// Adds where two regions, by Soup::sides, or two of `bodies` without them, are a hundredth of their facets apart, or
/// less: that is a warning; an error below 1e-4, which is what rounding leaves of a common wall. `soup`: without
/// errors; normals point out of the bodies. `facet_number`: of its facets, in the soup of the diagnosis; empty: the
/// same. Cost as find_gaps().
void add_gaps(Diagnosis& diagnosis, const Soup& soup, const GivenBodies& bodies,
              const std::vector<std::int32_t>& facet_number = {});

}  // namespace kerf
