// kerf export: a finished run in the formats of solvers.
#pragma once

#include <string>

namespace kerf {

struct ExportRequest {
    std::string folder;   ///< of the run
    std::string formats;  ///< list of names
    std::string output;   ///< folder; empty: that of the run
    std::int32_t into = 0;
};

/// Returns the exit code. Throws Error.
int export_run(const ExportRequest& request);

}  // namespace kerf
