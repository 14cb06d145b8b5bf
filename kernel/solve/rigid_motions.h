// Motions of whole bodies that nothing prevents.
#pragma once

#include <vector>

#include "solve/body_motions.h"
#include "solve/elastic_problem.h"

namespace kerf {

/// Of all bodies. What is as good as free is free: 1e-10 of what the motion held best has. Collective; O(n).
std::vector<BodyMotions> free_motions(const ElasticProblem& problem, const SpaceBodies& bodies);

/// Throws Error(usage) naming the rigid motions of bodies that the supports do not prevent. Collective.
void require_supported(const ElasticProblem& problem, const SpaceBodies& bodies);

}  // namespace kerf
