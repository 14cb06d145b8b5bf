// The totals of a report, from the reports of its parts.
#pragma once

#include "run/report/report.h"

namespace kerf {

/// Returns 0 if every part was meshed, `memory` if all that failed ran out of it, else `subdomain` (values of
/// ErrorCode).
int failure_code(const std::vector<PartReport>& parts);

/// Fills in the number of tetrahedra, the ways of parts, the recovery of facets, the verification, which must have the
/// counts of interfaces and of the input already, the seconds of the workers, the hash of the mesh and the exit code.
void add_up_parts(RunReport& report);

}  // namespace kerf
