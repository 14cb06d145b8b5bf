// The request of a caller of the facade, as the options of a run.
#pragma once

#include <string>

#include "kerf/kerf.h"
#include "run/request/run_request.h"

namespace kerf {

/// Throws Error(usage), naming the first one, if there are options of a surface, which exists already.
void refuse_options_of_surface(const NamedOptions& options);

/// Returns the options of a run on this input into a folder. Throws Error(usage) for names and values that are no
/// options.
RunRequest run_options(const std::string& input, const MeshOptions& options, const std::string& folder);

}  // namespace kerf
