// kerf verify: a finished run, checked again from its files.
#pragma once

#include <string>

namespace kerf {

/// Prints what was found to standard output. Returns 0 if every law holds, else 8. Throws Error(io) for a folder that
/// is no finished run.
int verify_run(const std::string& folder);

}  // namespace kerf
