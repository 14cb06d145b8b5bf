// Messages about parts that could not be meshed.
#pragma once

#include "run/report/report.h"

namespace kerf {

/// Prints for each failed part its place, the reason and the way to repeat the failure, and then the way to go on.
void tell_failed_parts(const RunReport& report);

}  // namespace kerf
