// What a user has to know of parts that could not be meshed.
#pragma once

#include "report/report.h"

namespace kerf {

/// Prints for each of them where it lies, why it failed and how to repeat that, and what is left to do.
void tell_failed_parts(const RunReport& report);

}  // namespace kerf
