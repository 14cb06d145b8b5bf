// What a report says of the whole mesh, from what it says of its parts.
#pragma once

#include "report/report.h"

namespace kerf {

/// 0 if every part was meshed; `memory` if all that failed ran out of it, else `subdomain`.
int failure_code(const std::vector<PartReport>& parts);

/// Fills the number of tetrahedra, the ways of parts, the recovery of facets, the verification, which must have the
/// counts of interfaces and of the input already, the seconds of the workers, the hash of the mesh and the exit code.
void add_up_parts(RunReport& report);

}  // namespace kerf
