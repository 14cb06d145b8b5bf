// Closed bodies that are meshed together, before they are known to be regions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/diagnosis/diagnosis.h"

namespace kerf {

/// The body that each facet of a soup belongs to.
struct GivenBodies {
    std::vector<std::int32_t> of_facet;  ///< #F; index into `names`
    std::vector<std::string> names;
};

/// Makes each patch a body, if there are several and each of them that has facets is closed by itself: an even number
/// of its facets meets at every edge. Returns nothing otherwise. O(#F log #F).
GivenBodies closed_patches(const Soup& soup);

/// Joins patches with common vertices to one body, which has the name of the first of them. Closed bodies that are
/// apart are told from each other in this way. O(#V + #F).
GivenBodies separate_patches(const Soup& soup);

/// Finds the defects of each body alone, as diagnose() does, with its name in Defect::bodies; and, if none of these
/// keeps a body from being meshed, the places where two bodies overlap or have unlike facets
/// (surface/diagnosis/inside/wall_mismatch.h). Requirements as diagnose().
Diagnosis diagnose_bodies(const Soup& soup, const GivenBodies& bodies, const DiagnosisOptions& options = {});

/// Adds the places where two regions (by Soup::sides), or two of `bodies` without sides, are at most a hundredth of a
/// facet's longest edge apart. A gap is a warning; up to 1e-4, which rounding leaves of a common wall, it is an error.
/// `soup`: without errors; normals point out of the bodies. `facet_number`: the number of each facet in the soup of the
/// diagnosis; empty if they agree. Cost as find_gaps().
void add_gaps(Diagnosis& diagnosis, const Soup& soup, const GivenBodies& bodies,
              const std::vector<std::int32_t>& facet_number = {});

}  // namespace kerf
