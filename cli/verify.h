// kerf verify: a finished run, checked again from its files.
#pragma once

#include <string>

#include "run/verify_folder.h"

namespace kerf {

/// Prints what was found to standard output. Returns 0 if every law that was asked for holds, 8 if one does not, 7 if
/// all that can be told without the input hold, but that is gone or another. Throws Error(io) for a folder that
/// is no finished run.
int verify_run(const std::string& folder, const VerifyOptions& options);

}  // namespace kerf
