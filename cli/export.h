// kerf export: a finished run in the formats of solvers.
#pragma once

#include "run/export_run.h"

namespace kerf {

/// Under mpirun, too. Returns the exit code, the same on every rank.
int export_formats(ExportRequest request, bool quiet);

}  // namespace kerf
