// Motions of whole bodies that nothing prevents.
#pragma once

#include <vector>

#include "solve/equations/elastic_problem.h"
#include "solve/equations/inside/body_motions.h"

namespace kerf {

/// Returns the motions of all bodies. A motion is free if the square of its held displacements is at most 1e-10 times
/// that of the motion that is held best. Collective; O(n).
std::vector<BodyMotions> free_motions(const ElasticProblem& problem, const SpaceBodies& bodies);

/// Throws Error(usage) naming the rigid motions of bodies that the supports do not prevent. Collective.
void require_supported(const ElasticProblem& problem, const SpaceBodies& bodies);

}  // namespace kerf
