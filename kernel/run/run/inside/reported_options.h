// The options of a run, from its report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/request/run_request.h"

namespace kerf {

/// Returns the options of a report. `options`: the member of that name of report.json. Options that it does not have
/// are as they are by default.
RunRequest options_of_report(const nlohmann::json& options);

}  // namespace kerf
